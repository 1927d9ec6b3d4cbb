#include "schema/catalogue/ladder_state.hpp"

#include <fmt/format.h>

#include "schema/catalogue/database.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::schema {
namespace {

// Returns the levels with their angles, without counts.
LadderState empty_ladder(SQLite::Database& database) {
  LadderState ladder;
  if (read_levels(database).empty()) return ladder;
  SQLite::Statement rows(database, "SELECT deploys_from_deg FROM level ORDER BY number");
  while (rows.executeStep()) {
    if (ladder.levels.empty()) ladder.levels.emplace_back();
    ladder.levels.emplace_back();
    ladder.levels.back().deploys_from_deg = rows.getColumn(0).getDouble();
  }
  return ladder;
}

void add(const LevelCount& count, LadderLevel& level) {
  level.particles += count.particles;
  level.survivors += count.survivors;
  level.ancestors += count.ancestors;
  level.tried += count.tried;
  level.taken += count.taken;
  level.undecided += count.undecided;
  level.met += count.met;
  level.seconds += count.seconds;
}

}  // namespace

LadderState read_ladder(SQLite::Database& database, std::uint64_t end) {
  return reading(database, [&] {
    LadderState ladder = empty_ladder(database);
    std::vector<std::vector<double>> shares(ladder.levels.size());
    each_population(database, [&](const DrawRange& numbers, const std::vector<LevelCount>& counts) {
      if (numbers.lo >= end) return;
      ++ladder.populations;
      for (std::size_t k = 0; k < ladder.levels.size(); ++k) {
        shares[k].push_back(share_reaching(static_cast<std::uint32_t>(k), counts));
        if (k < counts.size()) add(counts[k], ladder.levels[k]);
      }
    });
    for (std::size_t k = 0; k < shares.size(); ++k) ladder.levels[k].rate = split_rate(shares[k]);
    return ladder;
  });
}

std::string ladder_sql(const LadderState& ladder) {
  std::vector<std::string> rows;
  if (ladder.levels.empty()) {  // VALUES needs a row
    rows.emplace_back(
        "(NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL)");
  }
  for (std::size_t k = 0; k < ladder.levels.size(); ++k) {
    const LadderLevel& level = ladder.levels[k];
    const auto number = [](std::optional<double> value) {
      return value ? fmt::format("{:.17g}", *value) : std::string("NULL");
    };
    const auto& interval = level.rate.interval;
    rows.push_back(fmt::format("({}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {})", k,
                               k > 0 ? number(level.deploys_from_deg) : "NULL",
                               number(level.rate.mean), interval ? number(interval->low) : "NULL",
                               interval ? number(interval->high) : "NULL", level.rate.reached,
                               level.particles, level.survivors, level.ancestors, level.tried,
                               level.taken, level.met, number(level.seconds)));
  }
  return fmt::format(
      "WITH ladder (level, deploys_from_deg, rate, rate_low, rate_high, populations_here, "
      "particles, survivors, ancestors, tried, taken, met, worker_seconds) AS (VALUES {}) "
      "SELECT * FROM ladder WHERE level IS NOT NULL",
      fmt::join(rows, ", "));
}

}  // namespace misalign::schema
