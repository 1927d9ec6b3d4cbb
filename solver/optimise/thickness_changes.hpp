// How the thickness that plates may have changes with where the vertices lie.
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

/// From flat to `from_deg`, otherwise to D, with the usual trim (contact.hpp): of the pairs of
/// panels that come closest at some angles, with points of a panel that keep their places on it,
/// and of the tapers. Empty where it is not known, or panels meet.
std::vector<LengthGradient> thickness_changes(const Sheet& sheet, PathGradients& gradients,
                                              std::optional<double> from_deg);

/// Of panels that are apart, or of what trims leave of them, by corners on the flat sheet (mm, A1
/// at the origin).
LengthGradient distance_gradient(const Sheet& sheet, const PathGradients::Shape& folded,
                                 int panel_a, int panel_b, const PolygonCorners& flat_a_mm,
                                 const PolygonCorners& flat_b_mm);

}  // namespace misalign::solver
