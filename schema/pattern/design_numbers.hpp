// Reads and writes the numbers of a design by their table.
#pragma once

#include <string_view>

#include "schema/files/input.hpp"
#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// Reads one number; null means absent unless there is a default.
void read_number(ObjectReader& reader, const DesignNumber& row, Design& design);
/// Reads the numbers of a block.
void read_numbers(ObjectReader& reader, std::string_view block, Design& design);
/// Returns the numbers of a block with their defaults; null for absent values without a default.
Json numbers_json(const Design& design, std::string_view block);

}  // namespace misalign::schema
