// The card of a sheet, as text.
#pragma once

#include <string>

#include "schema/kit/card.hpp"

namespace misalign::search {

/// Requirements as a table, then what is known besides.
std::string card_text(const schema::Card& card);

}  // namespace misalign::search
