// The progress of a campaign, and what it found, as JSON.
#pragma once

#include "schema/catalogue/catalogue_state.hpp"

namespace misalign::schema {

/// The ladder of a state that has one: populations, and what was found at each level.
Json ladder_json(const CatalogueState& state);

/// The contract's `status --json`, without the survival of its draws.
Json status_json(const CatalogueState& state);

/// Accepted draws of a state that deploy from another angle than the campaign's threshold.
struct DeployingFrom {
  double at_deg;
  std::uint64_t accepted;
};
Json deploying_json(const DeployingFrom& deploying, const CatalogueState& state);

/// The state as the page has it: status_json; of a splitting search also why its rate is not to be
/// believed yet, in the words of `status`, and what its numbers are made of.
Json page_state_json(const CatalogueState& state);

}  // namespace misalign::schema
