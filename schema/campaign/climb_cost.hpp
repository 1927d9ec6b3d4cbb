// The likely cost of a splitting search, estimated before it runs.
#pragma once

#include "schema/campaign/splitting.hpp"

namespace misalign::schema {

/// The share of particles that a level finder wants to reach the next level from each.
inline constexpr double kShareOfLevel = 0.2;
/// As many plain draws take as long as one move, whose sheet is nearly good enough, so that its
/// path is followed further: 35 (6 x 6 at 180 degrees) to 70 (10 x 10 from 174),
/// results/splitting/rare.md.
inline constexpr double kDrawsOfMove = 50;

/// Of one population.
struct ClimbCost {
  double levels;  ///< a whole number, the threshold among them
  double moves;
  double draws;  ///< plain draws that take as long, first draws and moves together
};

/// Of a search for what this share of the draws does, above 0: half as many first draws as there
/// are particles reach the first level, and a fifth of the particles every further one, as a
/// level finder wants it.
ClimbCost climb_cost(const Splitting& splitting, double share);

}  // namespace misalign::schema
