// Writes the progress and rates of a splitting search for people.
#pragma once

#include <string>

#include "schema/catalogue/catalogue_state.hpp"

namespace misalign::search {

/// Requires a state with a ladder, as all below. The table has a row for each level; a sentence
/// follows if the rate has not converged yet.
std::string ladder_text(const schema::CatalogueState& state);
/// "populations from 0 to 100, 12 of them missing".
std::string population_goal(const schema::CatalogueState& state);
/// "6 populations, 3094 candidates, 1 in 98000 draws (95 %: ...)", for one line.
std::string ladder_summary(const schema::CatalogueState& state);

}  // namespace misalign::search
