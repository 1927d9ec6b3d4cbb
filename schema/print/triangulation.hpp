// Divides a polygon with holes into triangles.
#pragma once

#include <array>
#include <vector>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

/// Triangles of a simple polygon (the first ring, counter-clockwise) without its holes (clockwise,
/// apart from each other), by clipping ears (Meisters 1975), counter-clockwise: numbers of the
/// rings' points, counted through all rings. Each side of a ring is that of one triangle.
std::vector<std::array<int, 3>> triangulated(const std::vector<PlanePoints>& rings);

}  // namespace misalign::schema
