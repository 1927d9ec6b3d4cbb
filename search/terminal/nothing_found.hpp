// Explains a campaign without candidates: the angles from which draws deploy, the largest possible
// acceptance rate, and what to try next.
#pragma once

#include <string>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/survival.hpp"

namespace misalign::search {

/// Writes estimates from the fault sample: angles from which shares 0.5, 0.1, 0.01 and 0.001 of the
/// draws deploy, if enough draws were seen; the largest angle seen; the extrapolated share at a
/// threshold that no draw reached; the angle that one draw in a thousand reaches; the cost of a
/// population of a splitting search, if it is below that of plain draws. Unknown values are null.
schema::Json survival_json(const schema::Survival& survival, const schema::CatalogueState& state);

/// Plain sentences, empty if something was accepted or nothing was drawn.
std::vector<std::string> nothing_found(const schema::Survival& survival,
                                       const schema::CatalogueState& state);

/// The same for an open catalogue of this state.
std::vector<std::string> nothing_found(SQLite::Database& database,
                                       const schema::CatalogueState& state);

}  // namespace misalign::search
