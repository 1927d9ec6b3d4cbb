// Reads a catalogue's campaign, goal, totals, finished units, and draws.
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

/// Totals of the draws below the goal's end.
struct CatalogueState {
  std::string identity, name;
  std::uint64_t seed;
  Goal goal;
  std::uint64_t goal_end;
  double threshold_deg;                ///< least D of accepted draws
  std::optional<double> stops_at_deg;  ///< angle of the stop, if the campaign has one
  bool by_energy = false;              ///< true if a filling's energy judges draws
  bool has_margin = false;             ///< true if that energy has to have a margin, too
  std::uint64_t draws, accepted, rejected, undecided;  ///< counts below the goal's end
  std::uint64_t draws_in_ledger;
  std::vector<DrawRange> gaps;
  std::string digest;
  std::map<std::string, WeightedCount>
      faults;                         ///< first faults of the rejected draws in the sample
  std::optional<LadderState> ladder;  ///< only of a splitting search
  std::optional<EndsState> ends;      ///< only of an optimising search
  double draws_per_s;                 ///< rate of all ranks in the last run that committed a unit

  /// Returns the sum over all first faults of the sample.
  WeightedCount sampled() const;
  /// Returns the number of draws in the gaps, or of populations.
  std::uint64_t missing() const;
  std::uint64_t missing_populations() const;
};

/// Reads the state of a catalogue. UserError (bad_input) if the ledger contradicts itself; likewise
/// below.
CatalogueState read_state(SQLite::Database& database);

/// Reads the campaign of a catalogue.
Campaign read_campaign_of(SQLite::Database& database, const std::string& path);

/// Returns the ledger's units, ascending.
std::vector<DrawRange> units_done(SQLite::Database& database);

/// Returns the draws of a range that are in a table (candidate, undecided or fault_sample),
/// ascending.
std::vector<std::uint64_t> draws_of(SQLite::Database& database, const std::string& table,
                                    const DrawRange& range);

/// Returns the goal's end by the catalogue's rows, see GoalEnd. UserError (bad_input) if
/// populations contradict themselves.
GoalEnd goal_end_of_rows(SQLite::Database& database, const Goal& goal);

/// Returns the number of accepted draws below the goal's end with `sample` or more as D.
std::uint64_t count_deploying_from(SQLite::Database& database, int sample);

}  // namespace misalign::schema
