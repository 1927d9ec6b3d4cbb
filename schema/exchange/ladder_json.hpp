// How far a splitting search is, and how rare is what it finds, as JSON.
#pragma once

#include "schema/catalogue/catalogue_state.hpp"

namespace misalign::schema {

/// Of a state that has a ladder: populations, and what was found at each level.
Json ladder_json(const CatalogueState& state);

}  // namespace misalign::schema
