#include "search/sheets/folding_model.hpp"

#include "schema/pattern/fill_json.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::search {

FoldingModel::FoldingModel(const schema::Pattern& base, const schema::Sampling& sampling,
                           const schema::Design& design, const StationOptions& stations)
    : base_(base),
      sampling_(sampling),
      design_(design),
      model_(model_of(base, sampling, stations)),
      solver_(model_) {
  schema::check_fill(design_, base_.base);
}

FoldingModel::FoldingModel(const schema::Campaign& campaign, const StationOptions& stations)
    : base_(campaign.pattern),
      sampling_(campaign.sampling()),
      design_(campaign.design),
      model_(model_of(campaign, stations)),
      solver_(model_) {
  schema::check_fill(design_, base_.base);
}

void check_shapes(const solver::Sheet& sheet, const std::vector<Eigen::Index>& rows) {
  const solver::Panels& panels = sheet.panels();
  solver::ShapeCheck check(sheet.vertices_mm(), panels.corners, panels.folds);
  std::vector<double> claimed_deg(panels.folds.size());
  for (const Eigen::Index row : rows) {
    const Eigen::Matrix3Xd& shape_mm = sheet.shapes_mm()[static_cast<std::size_t>(row)];
    Eigen::Matrix3Xd corners_mm(3, 4 * panels.corners.size());
    Eigen::Index corner = 0;
    for (const auto& panel : panels.corners) {
      for (const int v : panel) corners_mm.col(corner++) = shape_mm.col(v);
    }
    for (std::size_t i = 0; i < claimed_deg.size(); ++i) {
      claimed_deg[i] = sheet.history().fold_angle_deg(row, static_cast<Eigen::Index>(i));
    }
    check.see(shape_mm, corners_mm, claimed_deg);
  }
  const solver::ShapeCheck::Errors& worst = check.worst();
  const double limit_rad = solver::shape_tolerance(panels);
  const double limit_mm = limit_rad * sheet.mechanism().panel_width_mm;
  if (worst.length_mm <= limit_mm && worst.planarity_mm <= limit_mm &&
      worst.angle_deg <= limit_rad / solver::kRadPerDeg && worst.wrong_sign < 0) {
    return;
  }
  throw schema::UserError(
      schema::Cause::check_failed,
      sheet.name() + ": its folded shape is not that of rigid panels (" +
          schema::shown_number(worst.length_mm) + " mm, " + schema::shown_number(worst.angle_deg) +
          " deg off), so nothing is written of it; `misalign verify` shows more");
}

}  // namespace misalign::search
