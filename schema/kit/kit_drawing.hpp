// Draws a kit to cut: the sheet's numbered parts and notes, laid out on sheets of material.
#pragma once

#include <string>
#include <vector>

#include "schema/exchange/line_drawing.hpp"
#include "schema/kit/kit_options.hpp"
#include "schema/kit/panel_corner.hpp"

namespace misalign::schema {

struct KitDrawings {
  std::vector<LineDrawing> beds;  ///< one if no bed is given; without empty layers
  std::string warning;            ///< names springs that contradict the verdict; heads each drawing
};

/// UserError (bad_request) if the options do not go together, a panel or a table does not fit the
/// bed, bores or tabs do not fit a panel, or the kerf is too wide.
KitDrawings kit_drawings(const solver::Sheet& sheet, const KitOptions& options,
                         const std::string& title);

}  // namespace misalign::schema
