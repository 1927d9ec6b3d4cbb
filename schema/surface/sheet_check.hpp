// Checks that a triangle mesh is one sheet above the plane: a surface for a folded sheet to have.
#pragma once

#include "schema/surface/triangle_mesh.hpp"

namespace misalign::schema {

/// Adds faults, a sentence for each kind: too small or large in x and y, edges of more than two
/// triangles, several parts, no rim, holes, overhangs or triangles as steep as kSteepest_deg, and
/// places with two heights.
void find_sheet_faults(const TriangleMesh& mesh, InputFaults& faults);

inline constexpr double kSteepest_deg = 85;

}  // namespace misalign::schema
