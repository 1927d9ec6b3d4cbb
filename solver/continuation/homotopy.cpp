#include "solver/continuation/homotopy.hpp"

namespace misalign::solver {
namespace {

// Number of stations of the share: one at every tenth.
constexpr int kShares = 10;

}  // namespace

StartFinder::~StartFinder() = default;

// Scales all lengths with the pilot's angle at the first station.
CloseSteps::Options options_of_shares(const HalfAngle<double>& pilot) {
  const double unit_rad = 2 * pilot.s;
  CloseSteps::Options options;
  // Creases may turn by half of the pilot's angle between two stations; farther turns have left the
  // branch.
  options.longest_half_sine = 0.5 * pilot.s;
  options.least_tangent_cosine = 0.9;
  options.arc.longest_step_rad = 0.05 * unit_rad;
  options.arc.shortest_step_rad = 1e-7 * unit_rad;
  options.arc.least_tangent_cosine = 0.9;
  options.arc.most_steps = 20000;
  options.arc.limit_tolerance_rad = 1e-3 * unit_rad;
  return options;
}

// Plans shares from 0 to 1, represented by angles from 0 to the pilot's at the first station.
PathPlan plan_of_shares(const PathPlan& path, const Mechanism& mechanism) {
  PathPlan shares;
  const Station& first = path.stations.front();
  for (int k = 0; k <= kShares; ++k) {
    const double angle_deg = k == kShares ? first.pilot_deg : first.pilot_deg * k / kShares;
    shares.stations.push_back(
        {angle_deg, k == kShares ? first.pilot : half_angle_of_deg(angle_deg), 0, false});
  }
  shares.start = path.start;
  shares.start.creases[mechanism.pilot] = {1, 0};
  return shares;
}

}  // namespace misalign::solver
