// The lines of a card about contact of panels and springs.
#pragma once

#include <vector>

#include "schema/exchange/card_json.hpp"
#include "search/sheets/chosen_sheet.hpp"

namespace misalign::search {

/// First contact, panel thickness, and clearance of the springs: required where the design gives
/// their diameter. The sheet is used from `used_deg` on.
std::vector<schema::CardLine> contact_lines(const ChosenSheet& chosen, const solver::Sheet& sheet,
                                            const schema::Design& design, double used_deg);

}  // namespace misalign::search
