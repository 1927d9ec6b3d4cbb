// How far a campaign is and what it found, for people and as JSON.
#pragma once

#include <optional>
#include <string>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/terminal/terminal.hpp"

namespace misalign::search {

struct DeployingFrom {
  double at_deg;
  std::uint64_t accepted;
};
/// Not more than `state` says are accepted: a search may have committed some since. UserError (2)
/// if at_deg lies below the campaign's threshold or beyond its end.
DeployingFrom deploying_from(SQLite::Database& database, const schema::CatalogueState& state,
                             const schema::Campaign& campaign, double at_deg);
schema::Json deploying_json(const DeployingFrom& deploying, const schema::CatalogueState& state);

/// The state of a catalogue, for people or as JSON.
std::string status_text(const schema::CatalogueState& state,
                        const std::optional<DeployingFrom>& deploying, const Paint& paint);
schema::Json status_json(const schema::CatalogueState& state);

/// What somebody may want to type now; the campaign's file may be unknown (empty).
std::string next_step(const schema::CatalogueState& state, const std::string& path,
                      const std::string& campaign_path);

}  // namespace misalign::search
