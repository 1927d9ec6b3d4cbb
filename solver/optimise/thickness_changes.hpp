// Gradients of the largest thickness of plates by the coordinates of the vertices.
#pragma once

#include <optional>
#include <vector>

#include "solver/optimise/body_distance.hpp"

namespace misalign::solver {

/// Finds gradients of the closest pairs of panels at several angles from flat to `from_deg` or else
/// D, with the default trim (contact.hpp), points being fixed in their panels, and of the tapers.
/// Empty where they are not known, or panels meet.
std::vector<LengthGradient> thickness_changes(const Sheet& sheet, PathGradients& gradients,
                                              std::optional<double> from_deg);

}  // namespace misalign::solver
