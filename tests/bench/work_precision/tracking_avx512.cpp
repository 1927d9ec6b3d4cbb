// Compiled with -mavx512f.
#include <memory>
#include <xsimd/xsimd.hpp>

#include "tests/bench/work_precision/level.hpp"
#include "tests/bench/work_precision/tracking.hpp"

namespace misalign::bench {

using Lanes = xsimd::batch<double, xsimd::avx512f>;

Run track_in_lanes(const Problem& problem, const Demand& demand) {
  auto tracking = std::make_shared<StationTracking<Lanes>>(problem, demand);
  return [tracking](std::vector<Track>& tracks) { tracking->follow(tracks); };
}

Run functions_in_lanes(const Problem& problem, const Demand& demand) {
  auto tracking = std::make_shared<FunctionTracking<Lanes>>(problem, demand);
  return [tracking](std::vector<Track>& tracks) { tracking->follow(tracks); };
}

Run levels_in_lanes(const Problem& problem, const Demand& demand) {
  auto jumps = std::make_shared<LevelJumps<Lanes>>(problem, demand);
  return [jumps](std::vector<Track>& tracks) { jumps->follow(tracks); };
}

}  // namespace misalign::bench
