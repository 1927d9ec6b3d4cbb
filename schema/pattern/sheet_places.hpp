// Rows and columns of a sheet's faces.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

/// "the face A0-A1-A5-A4"
std::string face_label(const std::array<int, 4>& corners);

/// The reason why a sheet's faces have no rows and columns.
struct NoPlaces {
  std::string problem, why;
  const char* suggestion;
};

/// Rows and columns from the first face on, its corners turned so that its first side points most
/// to the right; every face begins at the corner of least row and column, and the least of both is
/// 0. `sheet` has vertices, facets (convex, turning left) and edges, its inner vertices join four
/// faces. A sheet in two pieces, or one that winds round itself, has none.
std::optional<NoPlaces> place_faces(solver::CreasePattern& sheet);

/// The median length of the faces' first sides.
double median_width_mm(const solver::CreasePattern& sheet);

}  // namespace misalign::schema
