#include "search/sheets/joint_of_design.hpp"

#include "schema/pattern/joint_kind.hpp"
#include "search/sheets/folding_model.hpp"
#include "solver/contact/contact.hpp"
#include "solver/play/joint_play.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {

std::optional<double> play_of(const schema::Design& design, const solver::Sheet& sheet) {
  std::optional<solver::JointParts> joints = schema::joints_of(design);
  if (design.play_mm || !joints) return design.play_mm;
  // Plates of its kit are trimmed as usual.
  if (design.thickness_mm && schema::are_set_back(design.crease_or(schema::CreaseCut::score))) {
    joints = joints->between_plates(solver::kTrimPart * sheet.mechanism().panel_width_mm);
  }
  return solver::joint_play(sheet, *joints, solver::rows_of_use(sheet, design.from_deg)).play_mm;
}

std::optional<double> play_of(const schema::Design& design, const schema::Campaign& campaign,
                              const std::vector<Eigen::Matrix2Xd>& shifts_mm) {
  if (design.play_mm || !design.joint_kind || shifts_mm.empty()) return design.play_mm;
  FoldingModel model(campaign);
  return play_of(design, model.sheet(shifts_mm.front()));
}

}  // namespace misalign::search
