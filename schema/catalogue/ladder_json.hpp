// The progress of a splitting search, and how rare its finds are, as JSON.
#pragma once

#include "schema/catalogue/catalogue_state.hpp"

namespace misalign::schema {

/// Of a state that has a ladder: populations, and what was found at each level.
Json ladder_json(const CatalogueState& state);

}  // namespace misalign::schema
