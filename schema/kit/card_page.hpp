// Writes the card of a sheet as a page to print.
#pragma once

#include "schema/exchange/card_json.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::schema {

/// HTML for one printed page of A4: requirements, drawings, springs and hinges. `actuation`: by the
/// design's springs, from the angle of use.
std::string card_page(const Card& card, const solver::Sheet& sheet,
                      const solver::Actuation& actuation);

}  // namespace misalign::schema
