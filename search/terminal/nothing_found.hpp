// Explains a campaign that accepted nothing: from which angle draws survive, how rare an accepted
// one is at most, and what to try next.
#pragma once

#include <string>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/survival.hpp"

namespace misalign::search {

/// Angles from which these shares of the draws deploy, as the fault sample has it: 0.5, 0.1, 0.01
/// and 0.001, those that enough draws were seen of; the deepest angle seen; a guess of the share at
/// the campaign's threshold where none was seen there; the angle that one draw in a thousand
/// survives; what a population of a splitting search would take, where that is less than plain
/// draws are likely to. Null for what is not known.
schema::Json survival_json(const schema::Survival& survival, const schema::CatalogueState& state);

/// Plain sentences, empty if something was accepted or nothing was drawn.
std::vector<std::string> nothing_found(const schema::Survival& survival,
                                       const schema::CatalogueState& state);

/// The same for an open catalogue of this state.
std::vector<std::string> nothing_found(SQLite::Database& database,
                                       const schema::CatalogueState& state);

}  // namespace misalign::search
