// Compiled with -mavx512f.
#include <memory>
#include <xsimd/xsimd.hpp>

#include "tests/bench/work_precision/tracking.hpp"

namespace misalign::bench {

Run track_in_lanes(const Problem& problem, const Demand& demand) {
  auto tracking = std::make_shared<Tracking<xsimd::batch<double, xsimd::avx512f>>>(problem, demand);
  return [tracking](std::vector<Track>& tracks) { tracking->follow(tracks); };
}

}  // namespace misalign::bench
