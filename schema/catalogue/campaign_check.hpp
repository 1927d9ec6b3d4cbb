// Checks a catalogue's campaign and runs against its other rows.
#pragma once

#include <optional>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// Checks the diagonals of the base pattern, and the goal's end, which needs the catalogue's
/// `state`; none where the state cannot be read.
void check_campaign_row(SQLite::Database& database, const Campaign& campaign,
                        const std::optional<CatalogueState>& state, std::vector<Finding>& findings);

/// Returns a finding if the stored goal's end differs from that of the results: nothing before it
/// is complete then. `state` and rows must be of one transaction.
std::optional<Finding> goal_fault(SQLite::Database& database, const CatalogueState& state);

/// Checks the screened counts: their angles are samples of the path, and they add up to the
/// rejected draws, or to more in a joined catalogue.
void check_screened(SQLite::Database& database, const Campaign& campaign,
                    std::vector<Finding>& findings);

/// Checks the ascents of an optimising search: each candidate has one, and no value is less than
/// that of its start.
void check_ascents(SQLite::Database& database, const Campaign& campaign,
                   std::vector<Finding>& findings);

/// Checks a population's level against the campaign: number of particles, moves per particle, and
/// at level 0 survivors among the first draws.
void check_level(const std::string& where, const LevelCount& level, const Splitting& splitting,
                 std::vector<Finding>& findings);

/// Checks every run: its units belong to its ranks, and every commit has at least one unit (of a
/// joined catalogue perhaps only a part); no commit took longer than all; times are times, its
/// schema is not newer than the file's, and its configuration belongs to the campaign. Its other
/// columns cannot be checked.
void check_runs(SQLite::Database& database, const Campaign& campaign,
                std::vector<Finding>& findings);

}  // namespace misalign::schema
