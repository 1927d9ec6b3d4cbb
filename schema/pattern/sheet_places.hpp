// Finds rows and columns of a sheet's faces.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

/// Returns "the face A0-A1-A5-A4".
std::string face_label(const std::array<int, 4>& corners);

/// The reason why a sheet's faces have no rows and columns.
struct NoPlaces {
  std::string problem, why;
  const char* suggestion;
};

/// Sets rows and columns from the first face on, with its corners turned so that its first side
/// points most to the right. Every face begins at the corner of least row and column; the least of
/// both is 0. `sheet` has vertices, facets (convex, turning left) and edges; its inner vertices
/// join four faces. Fails for a sheet in two pieces, or one that winds round itself.
std::optional<NoPlaces> place_faces(solver::CreasePattern& sheet);

/// Returns the median length of the faces' first sides.
double median_width_mm(const solver::CreasePattern& sheet);

}  // namespace misalign::schema
