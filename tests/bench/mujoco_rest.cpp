// An exported sheet, let go in MuJoCo until it rests: where that is.
//
//   mujoco_rest DAMPING FILE.xml...
//
// DAMPING, N mm s/rad, acts on each hinge of the joint tree. A sheet rests where the pilot's rate
// is small for a while.
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "tests/bench/mujoco_run.hpp"

namespace misalign {
namespace {

// Slower than this, degrees a second, for this long: with damping the rest of the way is a tenth of
// that.
constexpr double kSlow_deg_per_s = 0.02, kFor_s = 0.05, kMost_s = 20;

void let_go(const std::string& file, double damping) {
  MujocoRun run(file);
  run.damp(damping);
  const double start_deg = run.pilot_deg();
  double moved_s = 0;
  while (run.time_s() < kMost_s && run.time_s() - moved_s < kFor_s) {
    run.step();
    if (std::abs(run.pilot_rate_deg_per_s()) > kSlow_deg_per_s) moved_s = run.time_s();
  }
  std::printf("%s: from %.3f deg to %.4f deg in %.3f s, springs %.3g N mm\n", file.c_str(),
              start_deg, run.pilot_deg(), run.time_s(), run.spring_energy_n_mm());
  std::fflush(stdout);
}

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  try {
    for (int k = 2; k < argc; ++k) misalign::let_go(argv[k], std::stod(argv[1]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return argc > 2 ? 0 : 2;
}
