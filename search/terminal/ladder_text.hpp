// The progress of a splitting search, and how rare its finds are, for people.
#pragma once

#include <string>

#include "schema/catalogue/catalogue_state.hpp"

namespace misalign::search {

/// Of states that have a ladder, here and below. What takes the place of a plain campaign's table:
/// a row for each level, and a sentence where the rate is not to be believed yet.
std::string ladder_text(const schema::CatalogueState& state);
/// "populations from 0 to 100, 12 of them missing".
std::string population_goal(const schema::CatalogueState& state);
/// "6 populations, 3094 candidates, 1 in 98000 draws (95 %: ...)", for one line.
std::string ladder_summary(const schema::CatalogueState& state);

}  // namespace misalign::search
