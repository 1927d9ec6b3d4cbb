// Directions that separate two panels, guessed from their poses at one angle. Certifier and check
// both begin with these guesses, and prove them by their own arithmetic.
//
// Panels without a common vertex: all corners of the one lie on one side of some plane, all of the
// other's on the other. With one common vertex V: the other three corners of the one, and hence all
// of it but V, lie on one side of some plane through V, those of the other on the other. With a
// common crease: they lie in two half planes from it, which meet in it alone unless its fold angle
// is +-180 degrees; the conditions on creases exclude that.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "solver/contact/contact_finder.hpp"

namespace misalign::solver {

/// The four corners of a panel, a column each.
using PanelCorners = Eigen::Matrix<double, 3, 4>;

/// Two panels with a common vertex or none; its index among the corners of each, 0 without one.
struct ComparedPanels {
  ContactKind kind;
  std::size_t a, b;
  int vertex_of_a, vertex_of_b;
  int pair;  ///< index in pairs_of(panels)
};
/// All pairs except those with a common crease.
std::vector<ComparedPanels> compared_panels(const Panels& panels);

/// Returns a unit vector from a to b; none where they seem to meet.
std::optional<Eigen::Vector3d> separating_direction(const ComparedPanels& panels,
                                                    const PanelCorners& a, const PanelCorners& b);

}  // namespace misalign::solver
