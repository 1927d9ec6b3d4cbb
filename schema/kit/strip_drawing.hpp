// Draws the flexible strips of ball joints that are tabs.
#pragma once

#include "schema/kit/kit_bores.hpp"
#include "schema/kit/kit_layout.hpp"

namespace misalign::schema {

/// A strip for each ball joint, with the bores of both of its panels, the vertex' name, and lines
/// where the panels clamp it: its free length lies half on either side of the vertex. None where
/// joints are no tabs. UserError (bad_request) where bores leave no room for the free length.
KitSheets kit_strip_sheets(const solver::Sheet& sheet, const KitFittings& fittings,
                           const KitOptions& options, const std::string& title);

}  // namespace misalign::schema
