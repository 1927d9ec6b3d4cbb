// Keeps each sheet in the catalogue once.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "schema/campaign/campaign.hpp"
#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// Keeps of candidates of the same sheet that with the least number, which gets the others'
/// certificates and yields, and no more than stop.accepted candidates, those with the least
/// numbers. Considers sheets with a candidate in `added`. Updates the units' counts and digests. An
/// optimising search keeps the optimum of every start. Within a transaction; throws
/// SQLite::Exception.
void keep_each_sheet_once(SQLite::Database& database, const Campaign& campaign,
                          const solver::Mechanism& mechanism, const DrawRange& added);

}  // namespace misalign::schema
