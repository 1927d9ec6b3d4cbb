// Writes the numbers of a kit as tables of a page: shifts, springs, creases that were cut.
#pragma once

#include <string>

#include "schema/kit/kit_drawing.hpp"

namespace misalign::schema {

/// Tables: shifts (vertex, dx, dy); springs (number, ends, length of the diagonal and of the spring
/// when flat, length at the angle of use, stroke, trend, trend of the diagonal); lengths of springs
/// every ten degrees up to there; creases that were cut for the bed.
std::string kit_tables(const solver::Sheet& sheet, const Kit& kit, const KitOptions& options);

}  // namespace misalign::schema
