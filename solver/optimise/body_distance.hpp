// Gradients of the distances of panels and springs of a folded sheet by the coordinates of its flat
// vertices.
#pragma once

#include <vector>

#include "solver/contact/panel_distance.hpp"
#include "solver/optimise/path_gradients.hpp"

namespace misalign::solver {

/// A distance at one pilot angle, or another length that limits the sheet.
struct LengthGradient {
  double mm;
  Eigen::RowVectorXd by_mm;  ///< x and y of each vertex in turn
};

/// A convex body whose points move with vertices of the folded sheet.
struct PlacedBody {
  std::vector<int> vertices;
  Eigen::MatrixXd weights;  ///< weights of the vertices (rows) in each point of the outline
  PolygonCorners outline;
};

/// A part of a panel, given by corners on the flat sheet (mm, A1 at the origin).
PlacedBody placed_panel(const Sheet& sheet, const PathGradients::Shape& folded, int panel,
                        const PolygonCorners& flat_mm);
/// The line between two vertices without a share of its length at each end, below one half.
PlacedBody placed_line(const PathGradients::Shape& folded, int from, int to, double left_out);

/// Gradient of the distance of two disjoint bodies, their closest points being fixed in them.
LengthGradient distance_gradient(const PlacedBody& a, const PlacedBody& b,
                                 const PathGradients::Shape& folded);

}  // namespace misalign::solver
