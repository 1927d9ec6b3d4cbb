// Gives the outlines along which a sheet and its holes are cut.
#pragma once

#include <vector>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::solver {

/// Facets that are not holes, ascending. `holes` ascending too.
std::vector<int> kept_facets(const CreasePattern& sheet, const std::vector<int>& holes);

/// Closed walks over the edges where the sheet is cut, its material on the left: the perimeter
/// (counter-clockwise seen from +z), then each hole in turn (clockwise). The first vertex is not
/// repeated at the end.
std::vector<std::vector<int>> outlines(const CreasePattern& sheet, const std::vector<int>& holes);

}  // namespace misalign::solver
