// `misalign status`: how far a campaign is.
#pragma once

#include <optional>
#include <string>

#include "schema/catalogue_state.hpp"

namespace misalign::search {

/// The state of a catalogue, for people or as JSON.
std::string status_text(const schema::CatalogueState& state);
schema::Json status_json(const schema::CatalogueState& state);

struct DeployingFrom {
  double at_deg;
  std::uint64_t accepted;
};
/// Not more than `state` says are accepted: a search may have committed some since. UserError (2)
/// if at_deg lies below the campaign's threshold or beyond its end.
DeployingFrom deploying_from(SQLite::Database& database, const schema::CatalogueState& state,
                             const schema::Campaign& campaign, double at_deg);
std::string deploying_text(const DeployingFrom& deploying, const schema::CatalogueState& state);
schema::Json deploying_json(const DeployingFrom& deploying, const schema::CatalogueState& state);

}  // namespace misalign::search
