// Reads a catalogue: its campaign, goal and totals, the units that are done, draws.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "schema/campaign/goal.hpp"
#include "schema/catalogue/database.hpp"
#include "schema/catalogue/ends_state.hpp"
#include "schema/catalogue/ladder_state.hpp"
#include "schema/catalogue/weighted_count.hpp"

namespace misalign::schema {

/// Totals of what lies below the goal's end.
struct CatalogueState {
  std::string identity, name;
  std::uint64_t seed;
  Goal goal;
  std::uint64_t goal_end;
  double threshold_deg;                                ///< that accepted draws deploy from
  std::optional<double> stops_at_deg;                  ///< where they are to stop on the way
  std::uint64_t draws, accepted, rejected, undecided;  ///< below the goal's end
  std::uint64_t draws_in_ledger;
  std::vector<DrawRange> gaps;
  std::string digest;
  std::map<std::string, WeightedCount>
      faults;                         ///< first faults of the rejected draws in the sample
  std::optional<LadderState> ladder;  ///< of a splitting search
  std::optional<EndsState> ends;      ///< of an optimising search
  double draws_per_s;  ///< of the last run that committed something, all ranks together

  /// All first faults of the sample.
  WeightedCount sampled() const;
  /// Draws in the gaps, and populations.
  std::uint64_t missing() const;
  std::uint64_t missing_populations() const;
};

/// UserError (bad_input) if the ledger contradicts itself, here and below.
CatalogueState read_state(SQLite::Database& database);

/// The campaign that a catalogue belongs to.
Campaign read_campaign_of(SQLite::Database& database, const std::string& path);

/// The ledger's units, ascending.
std::vector<DrawRange> units_done(SQLite::Database& database);

/// The draws of a range that are in a table, ascending: candidate, undecided, fault_sample.
std::vector<std::uint64_t> draws_of(SQLite::Database& database, const std::string& table,
                                    const DrawRange& range);

/// Where a goal ends by what the rows say, see GoalEnd. UserError (bad_input) if populations
/// contradict themselves.
GoalEnd goal_end_of_rows(SQLite::Database& database, const Goal& goal);

/// Accepted draws below the goal's end that deploy from `sample` or more.
std::uint64_t count_deploying_from(SQLite::Database& database, int sample);

}  // namespace misalign::schema
