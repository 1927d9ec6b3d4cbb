// The card of a sheet, as text.
#pragma once

#include <string>

#include "schema/exchange/card_json.hpp"

namespace misalign::search {

/// Requirements as a table, then facts and notes.
std::string card_text(const schema::Card& card);

/// Requirements and facts of two sheets of one design, side by side.
std::string cards_text(const schema::Card& before, const schema::Card& after);

}  // namespace misalign::search
