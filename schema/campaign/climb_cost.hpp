// Estimates the cost of a splitting search before it runs.
#pragma once

#include "schema/campaign/splitting.hpp"

namespace misalign::schema {

/// Share of particles that the level finder lets reach the next level.
inline constexpr double kShareOfLevel = 0.2;
/// Plain draws in the time of one move: 35 (6 x 6 at 180 degrees) to 70 (10 x 10 from 174),
/// results/splitting/rare.md. A move's sheet is nearly good enough, so that its path is followed
/// further.
inline constexpr double kDrawsOfMove = 50;

/// Cost of one population.
struct ClimbCost {
  double levels;  ///< a whole number, with the threshold
  double moves;
  double draws;  ///< plain draws in the same time as first draws and moves together
};

/// Estimates the cost of a search for sheets with this share of the draws, above 0: half as many
/// first draws as there are particles reach the first level, and a fifth of the particles every
/// further one, as the level finder aims at.
ClimbCost climb_cost(const Splitting& splitting, double share);

}  // namespace misalign::schema
