// The parts of a kit: panels that creases hold together.
#pragma once

#include <vector>

#include "schema/kit/kit_options.hpp"
#include "schema/kit/panel_corner.hpp"

namespace misalign::schema {

struct KitPart {
  std::vector<int> facets;   ///< ascending
  std::vector<int> creases;  ///< the mechanism's, within the part; ascending
};

/// The parts that creases hold together (with creases that are apart: single panels), the largest
/// first, among equals by their least facet.
std::vector<KitPart> kit_parts(const solver::Sheet& sheet, CreaseCut crease);

/// Cuts a part along creases by a grid with about equal numbers of rows and columns of panels;
/// panels that creases join within a cell are a part.
std::vector<KitPart> divided(const solver::Sheet& sheet, const KitPart& part, int down, int across);

/// The numbers of the sheet's rows and columns that a part covers.
std::array<int, 2> rows_and_columns(const solver::Sheet& sheet, const KitPart& part);

}  // namespace misalign::schema
