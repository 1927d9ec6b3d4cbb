// Shows a sheet beside its target: the surface, and the panels' distances.
#pragma once

#include "schema/files/input.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::schema {

/// A sheet on its target, in the target's frame.
struct TargetView {
  solver::ShapePose pose;
  Eigen::Matrix3Xd placed_mm;   ///< the sheet's vertices
  Eigen::Index columns;         ///< points of the surface in a row
  Eigen::Matrix3Xd surface_mm;  ///< a square grid, a little wider than the sheet; none for places
  Eigen::VectorXd panels_mm;    ///< largest distance of what is measured on each panel
  double rms_mm, max_mm;
};

/// Lays a folded sheet on the target of `measure`, in its best pose.
TargetView target_view(const solver::Panels& panels, const Eigen::Matrix3Xd& vertices_mm,
                       const solver::ShapeMeasure& measure);

/// The target in the folding picture of a report: the surface's points in base64, relative to the
/// middle of the flat sheet as detail_json's shapes are. Null where the target is places, or the
/// sheet's history has no row there.
Json target_shown_json(const solver::Sheet& sheet, const solver::ShapeMeasure& measure);

/// The picture of both as an SVG file: the surface faint, panels coloured by distance.
std::string shape_picture(const std::string& title, const solver::Panels& panels,
                          const TargetView& view);

}  // namespace misalign::schema
