// A campaign with the program's own Dispatcher and Ledger, but workers, clock, network and disk
// that are only reckoned with: event after event, so that ten thousand ranks need no ten thousand
// cores.
#pragma once

#include <cstdint>

#include "tests/bench/scale/costs.hpp"

namespace misalign::bench {

struct Network {
  const char* name;
  double latency_s;    ///< one way
  double message_s;    ///< of rank 0's time, for a message that it sends or receives
  double bytes_per_s;  ///< that rank 0 receives
};

struct SimulatedCampaign {
  int workers;         ///< ranks besides rank 0
  double draws_per_s;  ///< of a worker in the middle; others by a lognormal spread
  double acceptance;
  const BlockTimes& own_blocks;  ///< of rank 0
  std::uint64_t draws;
};

struct SimulatedRun {
  double wall_s;
  double efficiency;  ///< draws over what all ranks could have made in that time
  double messages_per_s, units_per_s, commits_per_s;
  double idle_mean, idle_worst;             ///< shares of the workers' time up to the end game
  double committing, messaging, computing;  ///< shares of rank 0's time
  std::uint64_t units, candidates, sampled;
  double longest_commit_s, largest_commit_bytes;  ///< messages that are one transaction
  double end_game_s;                              ///< from the first worker without a range
  double lost_mean_s, lost_worst_s;  ///< draws that a kill loses, over the draws/s of all ranks
};

/// With a rank 0 that does what search/ranks/coordinator does, in that order.
SimulatedRun simulate(const SimulatedCampaign& campaign, const Network& network,
                      const Costs& costs);

}  // namespace misalign::bench
