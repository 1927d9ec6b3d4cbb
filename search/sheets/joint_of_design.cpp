#include "search/sheets/joint_of_design.hpp"

#include <algorithm>

#include "schema/pattern/joint_kind.hpp"
#include "search/sheets/folding_model.hpp"
#include "solver/play/joint_play.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {

std::optional<double> play_of(const schema::Design& design, const solver::Sheet& sheet) {
  const std::optional<solver::JointParts> joints = schema::joints_of(design);
  if (design.play_mm || !joints) return design.play_mm;
  const double used_deg = solver::angle_of_use(sheet, design.from_deg);
  const auto rows = std::ranges::count_if(sheet.history().stations, [&](const auto& station) {
    return station.pilot_deg <= used_deg + solver::kSameAngle_deg;
  });
  return solver::joint_play(sheet, *joints, rows).play_mm;
}

std::optional<double> play_of(const schema::Design& design, const schema::Campaign& campaign,
                              const std::vector<Eigen::Matrix2Xd>& shifts_mm) {
  if (design.play_mm || !design.joint_kind || shifts_mm.empty()) return design.play_mm;
  FoldingModel model(campaign);
  return play_of(design, model.sheet(shifts_mm.front()));
}

}  // namespace misalign::search
