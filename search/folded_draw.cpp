#include "search/folded_draw.hpp"

#include "search/draw.hpp"
#include "solver/half_angle.hpp"

namespace misalign::search {
namespace {

solver::PathPlanOptions path_of(const schema::Campaign& campaign, double look_deg) {
  solver::PathPlanOptions path = campaign.path();
  path.look_deg = look_deg;
  return path;
}

}  // namespace

solver::Actuators OtherActuators::instead_of(solver::Actuators actuators) const {
  if (stiffness_n_per_mm) actuators.stiffness_n_per_mm = *stiffness_n_per_mm;
  if (stroke_limit) actuators.stroke_limit = stroke_limit;
  return actuators;
}

DrawFolder::DrawFolder(const schema::Campaign& campaign, double look_deg)
    : campaign_(campaign),
      mechanism_(solver::build_mechanism(campaign.pattern.base.sheet, campaign.pattern.base.holes,
                                         campaign.pattern.base.folding)),
      elimination_(solver::plan_elimination(mechanism_, campaign.pattern.base.folding,
                                            campaign.pattern.base.sheet.vertices_mm)),
      plan_(solver::plan_path(mechanism_, campaign.pattern.base.folding,
                              campaign.pattern.base.sheet.vertices_mm,
                              path_of(campaign, look_deg))),
      panels_(solver::panels_of(campaign.pattern.base, mechanism_)) {}

FoldedDraw DrawFolder::fold(std::uint64_t draw) const {
  const solver::PerforatedSheet& base = campaign_.pattern.base;
  FoldedDraw folded;
  folded.draw = draw;
  folded.shifts_mm.setZero(2, base.sheet.vertex_count());
  draw_shifts(campaign_.misalignment, campaign_.seed, draw, folded.shifts_mm);
  folded.vertices_mm = base.sheet.vertices_mm + folded.shifts_mm;
  folded.path = solver::record_shapes(base, mechanism_, elimination_, plan_, folded.vertices_mm,
                                      campaign_.between_samples);
  const solver::Verdict& verdict = folded.path.history.verdict;
  folded.accepted = campaign_.accepts(verdict);
  folded.actuation = solver::actuate(campaign_.actuators, folded.path, folded.vertices_mm);
  if (verdict.deploys_from_sample > 0) {
    folded.metrics =
        solver::measure(base, folded.vertices_mm, folded.path.history, campaign_.sample_deg);
  }
  return folded;
}

schema::FoldingView DrawFolder::view(const FoldedDraw& folded) const {
  return {campaign_.pattern, folded.shifts_mm, mechanism_, folded.path.history,
          campaign_.sample_deg};
}

void DrawFolder::check_shapes(const FoldedDraw& folded,
                              const std::vector<Eigen::Index>& rows) const {
  solver::ShapeCheck check(folded.vertices_mm, panels_.corners, panels_.folds);
  std::vector<double> claimed_deg(panels_.folds.size());
  for (const Eigen::Index row : rows) {
    const Eigen::Matrix3Xd& shape_mm = folded.path.shapes_mm[static_cast<std::size_t>(row)];
    Eigen::Matrix3Xd corners_mm(3, 4 * panels_.corners.size());
    Eigen::Index corner = 0;
    for (const auto& panel : panels_.corners) {
      for (const int v : panel) corners_mm.col(corner++) = shape_mm.col(v);
    }
    for (std::size_t i = 0; i < claimed_deg.size(); ++i) {
      claimed_deg[i] = folded.path.history.fold_angle_deg(row, static_cast<Eigen::Index>(i));
    }
    check.see(shape_mm, corners_mm, claimed_deg);
  }
  const solver::ShapeErrors& worst = check.worst();
  const double limit_rad = solver::shape_tolerance(panels_);
  const double limit_mm = limit_rad * mechanism_.panel_width_mm;
  if (worst.length_mm <= limit_mm && worst.planarity_mm <= limit_mm &&
      worst.angle_deg <= limit_rad / solver::kRadPerDeg && worst.wrong_sign < 0) {
    return;
  }
  throw schema::UserError(
      schema::kExitCheckFailed,
      "draw " + std::to_string(folded.draw) + ": its folded shape is not that of rigid panels (" +
          schema::shown_number(worst.length_mm) + " mm, " + schema::shown_number(worst.angle_deg) +
          " deg off), so nothing is written of it; `misalign verify` says more");
}

}  // namespace misalign::search
