#include "solver/continuation/path.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// A quotient this close below a whole number, relative, is that number: 170.3 / 0.1.
constexpr double kWholeMultiple = 1e-9;

}  // namespace

PathPlan plan_path(const Mechanism& mechanism, const BaseFolding& folding,
                   const FlatVertices& base_vertices_mm, const PathPlanOptions& options) {
  assert(options.sample_deg > 0 && options.end_deg > 0);
  PathPlan plan;
  const auto add_multiples = [&](double step_deg, bool visit, bool sampled) {
    const int count = static_cast<int>(options.end_deg / step_deg * (1 + kWholeMultiple));
    for (int k = 1; k <= count; ++k) {
      const double angle_deg = std::min(k * step_deg, options.end_deg);
      plan.stations.push_back({angle_deg, {}, sampled ? k : 0, visit});
    }
  };
  add_multiples(options.sample_deg, true, true);
  if (options.look_deg > 0) add_multiples(options.look_deg, true, false);
  for (const double angle_deg : options.look_at_deg) {
    if (angle_deg <= options.end_deg) plan.stations.push_back({angle_deg, {}, 0, true});
  }
  if (options.sample_deg > options.longest_step_deg) {
    add_multiples(options.longest_step_deg, false, false);
  }
  plan.stations.push_back({options.end_deg, {}, 0, true});
  // Samples come first among equal angles and are kept.
  std::stable_sort(plan.stations.begin(), plan.stations.end(),
                   [](const Station& a, const Station& b) {
                     return a.pilot_deg < b.pilot_deg - kSameAngle_deg;
                   });
  plan.stations.erase(std::unique(plan.stations.begin(), plan.stations.end(),
                                  [](const Station& a, const Station& b) {
                                    return b.pilot_deg - a.pilot_deg <= kSameAngle_deg;
                                  }),
                      plan.stations.end());
  assert(plan.stations.front().pilot_deg > 0);
  for (Station& station : plan.stations) station.pilot = half_angle_of_deg(station.pilot_deg);
  plan.start = base_state(mechanism, folding, base_vertices_mm, plan.stations.front().pilot);
  return plan;
}

PathPoint::PathPoint(const Mechanism& mechanism)
    : state(flat_state<double>(mechanism)),
      lengths(mechanism.diagonals.size()),
      slopes(mechanism.diagonals.size()) {}

PathPoint::~PathPoint() = default;

void Effort::add(const PathResult& path) {
  solves += static_cast<std::uint64_t>(path.newton_solves + path.arc_steps);
  iterations += static_cast<std::uint64_t>(path.newton_iterations);
}

void Effort::add(const Effort& other) {
  solves += other.solves;
  iterations += other.iterations;
}

}  // namespace misalign::solver
