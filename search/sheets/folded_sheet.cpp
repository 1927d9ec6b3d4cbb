#include "search/sheets/folded_sheet.hpp"

#include "schema/exchange/actuators_json.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::search {

solver::Actuators OtherActuators::instead_of(solver::Actuators actuators) const {
  if (stiffness_n_per_mm) actuators.stiffness_n_per_mm = *stiffness_n_per_mm;
  if (stroke_limit) actuators.stroke_limit = stroke_limit;
  return actuators;
}

SheetFolder::SheetFolder(const schema::Pattern& base, const schema::Sampling& sampling,
                         const solver::Actuators& actuators, const StationOptions& stations)
    : base_(base),
      sampling_(sampling),
      actuators_(actuators),
      model_(model_of(base, sampling, stations)),
      panels_(solver::panels_of(base.base, mechanism())) {}

SheetFolder::SheetFolder(const schema::Campaign& campaign, const StationOptions& stations)
    : base_(campaign.pattern),
      sampling_(campaign.sampling()),
      actuators_(campaign.actuators),
      model_(model_of(campaign, stations)),
      panels_(solver::panels_of(base_.base, mechanism())) {}

FoldedSheet SheetFolder::fold(const Eigen::Matrix2Xd& shifts_mm) const {
  FoldedSheet folded;
  folded.shifts_mm = shifts_mm;
  folded.vertices_mm = base_.base.sheet.vertices_mm + shifts_mm;
  folded.path = solver::record_shapes(model_, folded.vertices_mm);
  folded.actuation = solver::actuate(actuators_, folded.path);
  if (folded.path.history.verdict.deploys_from_sample > 0) {
    solver::FoldingHistory& history = folded.path.history;
    const solver::PathRecord record = solver::settle_between(model_, folded.vertices_mm, history);
    folded.metrics = solver::measure(base_.base, folded.vertices_mm, record, sampling_.sample_deg);
  }
  return folded;
}

solver::ShapedPath SheetFolder::follow(const Eigen::Matrix2Xd& shifts_mm) const {
  const solver::FlatVertices vertices_mm = base_.base.sheet.vertices_mm + shifts_mm;
  solver::ShapedPath path = solver::record_shapes(model_, vertices_mm);
  solver::settle_between(model_, vertices_mm, path.history);
  return path;
}

schema::FoldingView SheetFolder::view(const FoldedSheet& folded) const {
  return {base_, folded.shifts_mm, mechanism(), folded.path.history, sampling_.sample_deg};
}

schema::Json SheetFolder::springs_json(const FoldedSheet& folded) const {
  schema::Json json = schema::actuation_history_json(view(folded), folded.path, folded.actuation);
  json["deploys_from_deg"] = folded.path.history.verdict.deploys_from_sample * sampling_.sample_deg;
  return json;
}

void SheetFolder::check_shapes(const FoldedSheet& folded, const std::vector<Eigen::Index>& rows,
                               const std::string& name) const {
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
  const double limit_mm = limit_rad * mechanism().panel_width_mm;
  if (worst.length_mm <= limit_mm && worst.planarity_mm <= limit_mm &&
      worst.angle_deg <= limit_rad / solver::kRadPerDeg && worst.wrong_sign < 0) {
    return;
  }
  throw schema::UserError(
      schema::Cause::check_failed,
      name + ": its folded shape is not that of rigid panels (" +
          schema::shown_number(worst.length_mm) + " mm, " + schema::shown_number(worst.angle_deg) +
          " deg off), so nothing is written of it; `misalign verify` says more");
}

}  // namespace misalign::search
