// The card of a sheet, as JSON.
#pragma once

#include "schema/kit/card.hpp"

namespace misalign::schema {

Json card_json(const Card& card);

}  // namespace misalign::schema
