// Each sheet stays in the catalogue once.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "schema/campaign/campaign.hpp"
#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// Of candidates that are the same sheet only the one with the least number stays, to which what is
/// known of the others goes (certificates, yields), and of all no more than stop.accepted, those
/// with the least numbers. Looks at sheets of which one lies in `added`. Their units' counts and
/// digests follow. Of an optimising search every start keeps its end. Within a transaction; throws
/// SQLite::Exception.
void keep_each_sheet_once(SQLite::Database& database, const Campaign& campaign,
                          const solver::Mechanism& mechanism, const DrawRange& added);

}  // namespace misalign::schema
