#include "schema/campaign/climb_cost.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::schema {

ClimbCost climb_cost(const Splitting& splitting, double share) {
  assert(share > 0 && splitting.first_draws > 0);
  const double particles = splitting.particles;
  const double first_share = std::min(1.0, particles / 2 / splitting.first_draws);
  const double further = std::log(first_share / share) / std::log(1 / kShareOfLevel);
  ClimbCost cost{};
  cost.levels = 1 + std::max(0.0, std::ceil(further));
  cost.moves = cost.levels * particles * splitting.sweeps;
  cost.draws = splitting.first_draws + kDrawsOfMove * cost.moves;
  return cost;
}

}  // namespace misalign::schema
