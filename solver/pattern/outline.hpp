// The outlines of a sheet without its holes, and where it is cut.
#pragma once

#include <vector>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::solver {

/// Facets that are not holes, ascending. `holes` ascending too.
std::vector<int> kept_facets(const CreasePattern& sheet, const std::vector<int>& holes);

/// Closed walks over the edges where the sheet is cut, its material on the left: the perimeter
/// (counter-clockwise seen from +z), then each hole in turn (clockwise). The last vertex is not the
/// first one again.
std::vector<std::vector<int>> outlines(const CreasePattern& sheet, const std::vector<int>& holes);

}  // namespace misalign::solver
