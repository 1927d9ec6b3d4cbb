// Each sheet stays in the catalogue once.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "schema/campaign/campaign.hpp"
#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// Candidates that are the same sheet become the one with the least number, which gets the others'
/// certificates and yields; no more than stop.accepted candidates of the catalogue stay, those
/// with the least numbers. Looks at sheets of which one lies in `added`. Their units' counts and
/// digests follow. Of an optimising search every start keeps its end. Within a transaction; throws
/// SQLite::Exception.
void keep_each_sheet_once(SQLite::Database& database, const Campaign& campaign,
                          const solver::Mechanism& mechanism, const DrawRange& added);

}  // namespace misalign::schema
