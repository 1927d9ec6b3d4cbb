// The card of a sheet, as text.
#pragma once

#include <string>

#include "schema/exchange/card_json.hpp"

namespace misalign::search {

/// Requirements as a table, then what is known besides.
std::string card_text(const schema::Card& card);

}  // namespace misalign::search
