// Replaces short edges of contours by fewer corners farther out.
#pragma once

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

/// Contours of fewer corners that hold at least the same material, which is on their left. Each
/// corner taken away adds at most `most_mm2`; contours that did not cross do not cross afterwards.
std::vector<PlanePoints> simple_rings(std::vector<PlanePoints> rings, double most_mm2);

}  // namespace misalign::schema
