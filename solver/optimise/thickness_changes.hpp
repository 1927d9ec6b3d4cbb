// Gradients of the largest thickness of plates by the coordinates of the vertices.
#pragma once

#include <optional>
#include <vector>

#include "solver/contact/panel_distance.hpp"
#include "solver/optimise/path_gradients.hpp"

namespace misalign::solver {

/// A distance of two panels at one pilot angle, or one of the limits of a thickness, which is the
/// least of all.
struct LengthGradient {
  double mm;
  Eigen::RowVectorXd by_mm;  ///< x and y of each vertex in turn
};

/// Finds gradients of the closest pairs of panels at several angles from flat to `from_deg` or else
/// D, with the default trim (contact.hpp), points being fixed in their panels, and of the tapers.
/// Empty where they are not known, or panels meet.
std::vector<LengthGradient> thickness_changes(const Sheet& sheet, PathGradients& gradients,
                                              std::optional<double> from_deg);

/// Gradient of the distance of two disjoint outlines, trimmed or not, given by corners on the flat
/// sheet (mm, A1 at the origin).
LengthGradient distance_gradient(const Sheet& sheet, const PathGradients::Shape& folded,
                                 int panel_a, int panel_b, const PolygonCorners& flat_a_mm,
                                 const PolygonCorners& flat_b_mm);

}  // namespace misalign::solver
