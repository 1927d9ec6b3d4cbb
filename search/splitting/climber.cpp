#include "search/splitting/climber.hpp"

#include <algorithm>
#include <functional>

#include "search/splitting/level_finder.hpp"

namespace misalign::search {
namespace {

// Takes a Population or a LevelFinder through all its levels.
template <class Climb>
void climb_alone(Climb& climb, Climber& climber) {
  while (!climb.is_done()) {
    PieceOrder order = *climb.take(kBeyondAll);
    const std::uint32_t end = order.hi;
    PieceWork work = climber.start(std::move(order));
    while (!work.finished()) work.run_next_block();
    climb.add(end, work.take());
  }
}

}  // namespace

Climber::Climber(const schema::Campaign& campaign, solver::InstructionSet set, const Parts& parts)
    : mechanism_(solver::build_mechanism(campaign.pattern.base)),
      moves_(campaign),
      sweeps_(campaign.search.splitting->sweeps),
      scorers_(campaign, set),
      ascend_(parts.ascend) {}

Ladder named_ladder(const schema::Campaign& campaign) {
  const schema::Splitting& splitting = *campaign.search.splitting;
  return {campaign.seed, schema::named_scores(splitting, campaign.sample_deg), splitting.particles,
          splitting.first_draws,
          campaign.search.optimisation ? campaign.search.optimisation->starts_of_population : 0};
}

Ladder stored_ladder(const schema::Campaign& campaign, const std::vector<int>& stored) {
  Ladder ladder = named_ladder(campaign);
  if (stored.empty() || stored == ladder.scores) return ladder;
  const bool is_possible = ladder.scores.empty() && stored.size() <= schema::kMostLevels &&
                           stored.front() > 0 && stored.back() == last_level(campaign) &&
                           std::ranges::is_sorted(stored, std::less_equal());
  if (!is_possible) {
    throw schema::UserError(schema::Cause::bad_input,
                            "the levels in the catalogue of " + campaign.name +
                                " do not fit its campaign (the file is damaged, or another program "
                                "changed it); restore a backup");
  }
  ladder.scores = stored;
  return ladder;
}

Ladder ladder_of(const schema::Campaign& campaign, Climber& climber) {
  Ladder ladder = named_ladder(campaign);
  if (!ladder.scores.empty()) return ladder;
  LevelFinder level_finder(ladder.seed, ladder.particles, ladder.first_draws, last_level(campaign));
  climb_alone(level_finder, climber);
  ladder.scores = level_finder.ladder().scores;
  return ladder;
}

PopulationRecord climbed(const Ladder& ladder, std::uint32_t number, Climber& climber) {
  Population population(ladder, number);
  climb_alone(population, climber);
  return population.record();
}

}  // namespace misalign::search
