// The story of a seed: a campaign on some ranks that is killed, stopped, starved of its disk and
// looked at through as many lives as it takes, until it must hold what a plain loop finds.
#pragma once

#include <string>

#include "tests/simulation/process.hpp"

namespace misalign::simulation {

/// The part of a story that is played: a failure that stays is easier to read with less.
struct Cast {
  int most_ranks = 12;
  int most_faulty_lives = 8;
  std::uint64_t left_out = 0;  ///< bit k: the k-th fault or happening of the story is left out
  bool tells = false;          ///< prints each life
};

/// Counts of what was played.
struct Tally {
  std::uint64_t seeds, lives, kills, power_cuts, stops, lost_ranks, looks, lock_holders, copies,
      merges, migrations, certify_runs, yield_runs, exports, second_searches, real_seeds;
};

/// Plays a seed, and adds to the tally. Returns what went wrong in one sentence; empty if nothing
/// did. `planned` is set to the number of faults and happenings.
std::string play(std::uint64_t seed, Disk& disk, const Cast& cast, Tally& tally, int& planned);

}  // namespace misalign::simulation
