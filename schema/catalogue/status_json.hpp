// Writes the progress and results of a campaign as JSON.
#pragma once

#include "schema/catalogue/catalogue_state.hpp"

namespace misalign::schema {

/// Returns the ladder of a state that has one: populations, and the counts of each level.
Json ladder_json(const CatalogueState& state);

/// Returns `status --json`, without the survival of the draws.
Json status_json(const CatalogueState& state);

/// Number of accepted draws that deploy from another angle than the campaign's threshold.
struct DeployingFrom {
  double at_deg;
  std::uint64_t accepted;
};
Json deploying_json(const DeployingFrom& deploying, const CatalogueState& state);

/// Returns the state for the page: status_json; of a splitting search also why its rate is not
/// reliable yet, in the words of `status`, and the data behind its numbers.
Json page_state_json(const CatalogueState& state);

}  // namespace misalign::schema
