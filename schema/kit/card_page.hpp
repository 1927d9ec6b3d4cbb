// The card of a sheet, as a page to print.
#pragma once

#include "schema/exchange/card_json.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::schema {

/// HTML that prints on a page of A4: requirements, a drawing, springs and hinges. `actuation`: of
/// the design's springs, from the angle of use.
std::string card_page(const Card& card, const solver::Sheet& sheet,
                      const solver::Actuation& actuation);

}  // namespace misalign::schema
