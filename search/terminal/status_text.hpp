// Writes the progress and results of a campaign for people.
#pragma once

#include <optional>
#include <string>

#include "schema/catalogue/status_json.hpp"
#include "search/terminal/terminal.hpp"

namespace misalign::search {

/// Counts candidates that deploy from `at_deg`, at most those accepted in `state`: a search may
/// have committed more since. UserError (bad_request) if at_deg lies below the campaign's threshold
/// or beyond its end.
schema::DeployingFrom deploying_from(SQLite::Database& database,
                                     const schema::CatalogueState& state,
                                     const schema::Campaign& campaign, double at_deg);

/// The state of a catalogue.
std::string status_text(const schema::CatalogueState& state,
                        const std::optional<schema::DeployingFrom>& deploying, const Paint& paint);

/// Suggests the next command; the campaign's file may be unknown (empty).
std::string next_step(const schema::CatalogueState& state, const std::string& path,
                      const std::string& campaign_path);

}  // namespace misalign::search
