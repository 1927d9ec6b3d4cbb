// Draws the rubber plates of a kit, free of stress, to be cut from a sheet of rubber.
#pragma once

#include <array>
#include <string>

#include "schema/kit/kit_layout.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// Corners of a hole's cut-out round the crossing of its diagonals, which it divides as the flat
/// hole does; the first diagonal leads from corner 0 to 2.
std::array<Eigen::Vector2d, 4> cut_out_mm(const solver::Sheet& sheet,
                                          const solver::RubberPlates& plates, int hole);

/// All plates, nested: a cut round the bonds, the line to lay on the hole's edges, which is
/// engraved, and the labels of hole and corners. UserError (bad_request) if one
/// cannot be drawn with its bonds, or does not fit the bed.
KitSheets kit_plate_sheets(const solver::Sheet& sheet, const solver::RubberPlates& plates,
                           const KitOptions& options, const std::string& title);

}  // namespace misalign::schema
