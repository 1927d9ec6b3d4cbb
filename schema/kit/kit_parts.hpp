// The parts of a kit: panels that creases hold together.
#pragma once

#include <vector>

#include "schema/kit/kit_options.hpp"
#include "schema/kit/panel_corner.hpp"

namespace misalign::schema {

struct KitPart {
  std::vector<int> facets;   ///< ascending
  std::vector<int> creases;  ///< of the mechanism, between two of them; ascending
};

/// What creases hold together (with CreaseCut::cut nothing): the largest first, among equals that
/// of the least facet.
std::vector<KitPart> kit_parts(const solver::Sheet& sheet, CreaseCut crease);

/// A part cut along creases into a grid of about equal numbers of the sheet's rows and columns that
/// it covers; what hangs together in a cell of it is a part.
std::vector<KitPart> divided(const solver::Sheet& sheet, const KitPart& part, int down, int across);

/// How many of the sheet's rows and columns a part covers.
std::array<int, 2> rows_and_columns(const solver::Sheet& sheet, const KitPart& part);

}  // namespace misalign::schema
