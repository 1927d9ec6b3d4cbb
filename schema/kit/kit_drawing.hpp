// A kit to cut: the sheet's parts with their numbers, laid out on sheets of material, with notes.
#pragma once

#include <string>
#include <vector>

#include "schema/exchange/line_drawing.hpp"
#include "schema/kit/kit_options.hpp"
#include "schema/kit/kit_sheet.hpp"

namespace misalign::schema {

/// A drawing for each bed; without beds one. Layers without a line are left out. UserError (2) if
/// the options do not go together, a panel does not fit the bed, bores do not fit a panel, or the
/// kerf is too wide.
std::vector<LineDrawing> kit_drawings(const KitSheet& sheet, const KitOptions& options,
                                      const std::string& title);

}  // namespace misalign::schema
