// What is written beside the parts of a kit: whose they are, a gauge, and tables.
#pragma once

#include <string>
#include <vector>

#include "schema/kit/kit_bores.hpp"
#include "schema/kit/kit_piece.hpp"

namespace misalign::schema {

/// Sentences within a width, a line or more each, and below them a line of exactly 100 mm between
/// two ticks.
KitPiece kit_heading(const std::vector<std::string>& sentences, double width_mm);
/// The least width that it needs.
inline constexpr double kLeastHeading_mm = 120;

/// The shifts as a table of vertex, dx and dy in mm, and with bores for springs another one of
/// springs: number, ends, length from vertex to vertex and from bore to bore, flat. Of the creases
/// (of the mechanism) that were cut for the bed a third. In blocks of at most that height.
std::vector<KitPiece> kit_tables(const KitSheet& sheet, const std::vector<Bore>& bores,
                                 const std::vector<int>& cuts, double most_height_mm);

}  // namespace misalign::schema
