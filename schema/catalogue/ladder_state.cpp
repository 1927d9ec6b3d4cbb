#include "schema/catalogue/ladder_state.hpp"

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/since.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::schema {
namespace {

// The levels with their angles, nothing counted yet.
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
    LadderState ladder;
    if (version_of(database) < kSplittingSince) return ladder;
    ladder = empty_ladder(database);
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

}  // namespace misalign::schema
