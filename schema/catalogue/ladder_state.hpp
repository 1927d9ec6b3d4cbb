// The counts of a splitting search at each of its levels, all populations together.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "schema/campaign/split_rate.hpp"
#include "schema/catalogue/population_rows.hpp"

namespace misalign::schema {

struct LadderLevel {
  double deploys_from_deg = 0;
  /// Sums over the populations. Particles are those that were there, after copying; at level 0
  /// first draws.
  std::uint64_t particles = 0, survivors = 0, ancestors = 0;
  std::uint64_t tried = 0, taken = 0, undecided = 0, met = 0;
  double seconds = 0;
  SplitRate rate;  ///< the share of draws that deploy from here; 1 at level 0
};

struct LadderState {
  std::uint64_t populations = 0;
  std::vector<LadderLevel> levels;  ///< from 0 on; none before they are known

  /// Of the campaign's criterion; nothing if no level is known.
  const SplitRate* rate() const { return levels.empty() ? nullptr : &levels.back().rate; }
};

/// Of the populations whose numbers lie below `end`. UserError (bad_input).
LadderState read_ladder(SQLite::Database& database, std::uint64_t end);

/// A SELECT of a row for each level, in numbers.
std::string ladder_sql(const LadderState& ladder);

}  // namespace misalign::schema
