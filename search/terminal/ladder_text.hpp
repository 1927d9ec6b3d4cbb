// How far a splitting search is, and how rare is what it finds, for people and as JSON.
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
schema::Json ladder_json(const schema::CatalogueState& state);
/// A SELECT of a row for each level, in numbers.
std::string ladder_sql(const schema::LadderState& ladder);
/// Why the rate is not to be believed yet; empty if it is.
std::string why_not_converged(const schema::SplitRate& rate);

}  // namespace misalign::search
