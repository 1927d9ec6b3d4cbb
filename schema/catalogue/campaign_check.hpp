// Checks what a catalogue says of its campaign and its runs against the rest of its rows.
#pragma once

#include <optional>
#include <vector>

#include "schema/catalogue/ledger_check.hpp"

namespace misalign::schema {

/// The diagonals of the base pattern, and where the goal ends by the results: that needs the
/// catalogue's `state`, none where it cannot be read.
void check_campaign_row(SQLite::Database& database, const Campaign& campaign,
                        const std::optional<CatalogueState>& state, std::vector<Finding>& findings);

/// For every run: its units are of its ranks, and it committed at least one unit each time (but for
/// those of catalogues that were joined, of which only a part may be here); its longest commit is
/// none longer than all.
void check_runs(SQLite::Database& database, std::vector<Finding>& findings);

}  // namespace misalign::schema
