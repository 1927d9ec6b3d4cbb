// Reads the part of the page that changes while a campaign runs.
#pragma once

#include "schema/campaign/campaign.hpp"
#include "schema/catalogue/database.hpp"

namespace misalign::search {

/// Reads all at one moment, in a short transaction: {"state", "faults": as the page has them,
/// without the list of gaps; "total": candidates in the
///  catalogue; "best": the first of them, as rows of the table; "angles": [[deploys_from_deg, how
///  many]...], ascending, of a plain search}. UserError (bad_input).
schema::Json live_state_json(SQLite::Database& database, const schema::Campaign& campaign);

}  // namespace misalign::search
