// Counts of a splitting search at each of its levels, over all populations.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "schema/campaign/split_rate.hpp"
#include "schema/catalogue/population_rows.hpp"

namespace misalign::schema {

struct LadderLevel {
  double deploys_from_deg = 0;
  /// Sums over the populations. Particles are counted after copying; at level 0 they are the first
  /// draws.
  std::uint64_t particles = 0, survivors = 0, ancestors = 0;
  std::uint64_t tried = 0, taken = 0, undecided = 0, met = 0;
  double seconds = 0;
  SplitRate rate;  ///< share of draws that deploy from this level; 1 at level 0
};

struct LadderState {
  std::uint64_t populations = 0;
  std::vector<LadderLevel> levels;  ///< level 0 first; empty before they are known

  /// Returns the rate of the campaign's criterion; null if no level is known.
  const SplitRate* rate() const { return levels.empty() ? nullptr : &levels.back().rate; }
};

/// Reads the ladder of the populations with numbers below `end`. UserError (bad_input).
LadderState read_ladder(SQLite::Database& database, std::uint64_t end);

/// Returns a SELECT that gives a row of numbers for each level.
std::string ladder_sql(const LadderState& ladder);

}  // namespace misalign::schema
