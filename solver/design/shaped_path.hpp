// A path with the folded sheet at each of its stations: for drawings, and whatever moves with them.
#pragma once

#include <vector>

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

struct ShapedPath {
  FoldingHistory history;
  std::vector<Eigen::Matrix3Xd> shapes_mm;  ///< 3 x vertices, one for each row of the history
  /// Of the sheet's span, between the two vertices that are farthest apart when flat: its rate of
  /// change at each row, from the exact rates of all joints.
  std::vector<double> span_slope_mm_per_deg;

  /// How many rows of the history lie up to D: the flat sheet not among them.
  Eigen::Index rows_up_to_d() const;
};

/// How many rows are shown of a path: those up to D, or of a sheet that deploys from nothing those
/// that are folded well, but for the rounding of angles near 180 degrees.
Eigen::Index rows_shown(const Mechanism& mechanism, const ShapedPath& path);
/// Those of them that become files, frames or lines of a table: multiples of `step_deg`, and the
/// last.
std::vector<Eigen::Index> rows_to_show(const Mechanism& mechanism, const ShapedPath& path,
                                       double step_deg);

/// As record_history. Each shape is turned and moved, as it is, to where it lies best over the flat
/// sheet at z = 0 (least squares over the vertices; Kabsch 1976), so that neighbours differ little.
ShapedPath record_shapes(const Model& model, const FlatVertices& vertices_mm);

}  // namespace misalign::solver
