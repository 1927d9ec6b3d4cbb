// Makes all plates of a kit as closed solids to print.
#pragma once

#include <vector>

#include "schema/kit/kit_options.hpp"
#include "schema/print/solid.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// The plates in the order of panels, with their ball joints where those are balls. UserError
/// (bad_request) if creases are no hinges of plates (film, bevel or pin), or where kit_fittings and
/// printed_plate have one.
std::vector<Solid> printed_kit(const solver::Sheet& sheet, const KitOptions& options);

}  // namespace misalign::schema
