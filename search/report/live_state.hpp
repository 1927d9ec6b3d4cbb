// Reads the part of the page that changes while a campaign runs.
#pragma once

#include "schema/campaign/campaign.hpp"
#include "schema/catalogue/database.hpp"

namespace misalign::search {

/// All candidates by D: [[deploys_from_deg, count]...], ascending.
schema::Json angles_json(SQLite::Database& database, double sample_deg);

/// Reads all at one moment, in a short transaction: {"state", "faults": as the page has them,
/// without the list of gaps; "total": candidates in the catalogue; "best": the first of them, as
/// rows of the table; "angles": of a plain search, angles_json}. UserError (bad_input).
schema::Json live_state_json(SQLite::Database& database, const schema::Campaign& campaign);

}  // namespace misalign::search
