#include "solver/continuation/homotopy.hpp"

namespace misalign::solver {
namespace {

// Shares at which the shifts pause: every tenth of them.
constexpr int kShares = 10;

}  // namespace

StartFinder::~StartFinder() = default;

// Everything is as small as the pilot's angle at the first station.
CloseSteps::Options options_of_shares(const HalfAngle<double>& pilot) {
  const double unit_rad = 2 * pilot.s;
  CloseSteps::Options options;
  // Creases at the first station may turn by this share of the pilot's own angle from one share to
  // the next: what goes farther has left the branch.
  options.longest_half_sine = 0.5 * pilot.s;
  options.least_tangent_cosine = 0.9;
  options.arc.longest_step_rad = 0.05 * unit_rad;
  options.arc.shortest_step_rad = 1e-7 * unit_rad;
  options.arc.least_tangent_cosine = 0.9;
  options.arc.most_steps = 20000;
  options.arc.limit_tolerance_rad = 1e-3 * unit_rad;
  return options;
}

// From no share to all of them, carried by angles from 0 to the pilot's at the first station.
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
