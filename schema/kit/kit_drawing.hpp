// A kit to cut: the sheet's parts with their numbers, laid out on sheets of material, with notes.
#pragma once

#include <string>
#include <vector>

#include "schema/exchange/line_drawing.hpp"
#include "schema/kit/kit_options.hpp"
#include "schema/kit/panel_corner.hpp"

namespace misalign::schema {

struct KitDrawings {
  std::vector<LineDrawing> beds;  ///< without beds one; layers without a line are left out
  std::string warning;            ///< of springs that contradict the verdict; stands first on each
};

/// UserError (bad_request) if the options do not go together, a panel or a table does not fit the
/// bed, bores or tabs do not fit a panel, or the kerf is too wide.
KitDrawings kit_drawings(const solver::Sheet& sheet, const KitOptions& options,
                         const std::string& title);

}  // namespace misalign::schema
