// One population for its estimate alone.
#pragma once

#include <utility>

#include "search/splitting/climber.hpp"

namespace misalign::bench {

/// As search::climbed(), but nothing moves at the last level: what that finds enters no estimate.
inline search::PopulationRecord climbed_to_top(const search::Ladder& ladder, std::uint32_t number,
                                               search::Climber& climber) {
  search::Population population(ladder, number);
  while (!population.is_done()) {
    search::PieceOrder order = *population.take(search::kBeyondAll);
    const std::uint32_t level = order.level, lo = order.lo, end = order.hi;
    search::PieceResult result;
    if (level < ladder.top()) {
      search::PieceWork work = climber.start(std::move(order));
      while (!work.finished()) work.run_next_block();
      result = work.take();
    } else {
      result.level = level;
      result.lo = lo;
      result.hi = end;
    }
    population.add(end, std::move(result));
  }
  return population.record();
}

}  // namespace misalign::bench
