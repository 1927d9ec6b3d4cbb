// Notes beside the parts of a kit: which sheet's they are, a gauge, and tables.
#pragma once

#include <string>
#include <vector>

#include "schema/kit/kit_item.hpp"
#include "schema/kit/kit_springs.hpp"

namespace misalign::schema {

/// Sentences within a width, a line or more each, and below them a line of exactly 100 mm between
/// two ticks.
KitItem kit_heading(const std::vector<std::string>& sentences, double width_mm);
/// The least width that it needs.
inline constexpr double kLeastHeading_mm = 120;

/// Tables in blocks of at most that height, if it has room for a row, and no wider than the least
/// heading where lengths are below 10 m. The shifts:
/// vertex, dx and dy in mm. Springs, flat: number, ends, length from vertex to vertex and between
/// its own ends; on the way to D: how long at D, its stroke, which way, and the diagonal's; their
/// lengths every ten degrees. Of the creases (of the mechanism) that were cut for the bed a last
/// one.
std::vector<KitItem> kit_tables(const solver::Sheet& sheet, const std::vector<KitSpring>& springs,
                                const std::vector<int>& cuts, double most_height_mm);

}  // namespace misalign::schema
