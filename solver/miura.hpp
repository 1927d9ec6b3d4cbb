// The Miura-ori of the paper (section 4, figure 12) at any size.
#pragma once

#include <vector>

#include "solver/base_folding.hpp"
#include "solver/crease_pattern.hpp"

namespace misalign::solver {

/// Vertex (i, j) lies at y = height i, x = width j, plus the offset when i is odd and 0 < j <
/// columns; the right border is straight at x = width columns + offset, the left one at x = 0.
struct MiuraShape {
  int rows, columns;
  double panel_width_mm, panel_height_mm, zigzag_offset_mm;
};

/// Vertices and facets row by row; the panel width is the length scale.
CreasePattern miura_sheet(const MiuraShape& shape);

/// Zigzag creases fold by the pilot's angle, straight ones by tan(rho/2) = cos(alpha) tan(rho_1/2)
/// with alpha = atan(height / offset); the pilot is A2-A9 on six columns, (0,1)-(1,1) in general.
BaseFolding miura_folding(const MiuraShape& shape, const CreasePattern& sheet);

/// Inner facets (r, c) with r + c odd (remainder 1) or even (0), ascending.
std::vector<int> checkerboard(const MiuraShape& shape, int remainder);

}  // namespace misalign::solver
