// Checks what a catalogue says of its campaign and its runs against the rest of its rows.
#pragma once

#include <optional>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// The diagonals of the base pattern, and where the goal ends by the results: that needs the
/// catalogue's `state`, none where it cannot be read.
void check_campaign_row(SQLite::Database& database, const Campaign& campaign,
                        const std::optional<CatalogueState>& state, std::vector<Finding>& findings);

/// Where the goal ends by the results, if the catalogue says otherwise: what is complete by that is
/// not. `state` and rows must be of one moment.
std::optional<Finding> goal_fault(SQLite::Database& database, const CatalogueState& state);

/// What was screened: at samples of the path, as many draws as were rejected, or more where
/// catalogues were joined.
void check_screened(SQLite::Database& database, const Campaign& campaign,
                    std::vector<Finding>& findings);

/// Of an optimising search: each candidate has its ascent, and a value that is no less than its
/// start's.
void check_ascents(SQLite::Database& database, const Campaign& campaign,
                   std::vector<Finding>& findings);

/// Of a population at a level, what the campaign knows: how many particles there are, and that each
/// tries so many moves; of its first draws it takes those that survive.
void check_level(const std::string& where, const LevelCount& level, const Splitting& splitting,
                 std::vector<Finding>& findings);

/// For every run: its units are of its ranks, and it committed at least one unit each time (but for
/// those of catalogues that were joined, of which only a part may be here); its longest commit is
/// none longer than all; its times and its units' are times, its schema is none newer than the
/// file's, and its configuration is one of the campaign. What else it says of itself nobody can
/// check.
void check_runs(SQLite::Database& database, const Campaign& campaign,
                std::vector<Finding>& findings);

}  // namespace misalign::schema
