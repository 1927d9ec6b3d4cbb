// Makes the notes of a kit: heading, gauge and tables.
#pragma once

#include <string>
#include <vector>

#include "schema/kit/kit_item.hpp"
#include "schema/kit/kit_springs.hpp"

namespace misalign::schema {

/// Sentences wrapped to a width, and below them a gauge of exactly 100 mm between two ticks.
KitItem kit_heading(const std::vector<std::string>& sentences, double width_mm);
/// The least width of a heading.
inline constexpr double kLeastHeading_mm = 120;

/// Tables in blocks of at most a height, if it has room for a row, and no wider than the least
/// heading for lengths below 10 m: shifts (vertex, dx, dy), springs when flat (number, ends, length
/// of the diagonal and of the spring), springs up to D (length at D, stroke, trend, trend of the
/// diagonal), spring lengths every ten degrees, and `cuts`: creases of the mechanism that were cut
/// for the bed.
std::vector<KitItem> kit_tables(const solver::Sheet& sheet, const std::vector<KitSpring>& springs,
                                const std::vector<int>& cuts, double most_height_mm);

}  // namespace misalign::schema
