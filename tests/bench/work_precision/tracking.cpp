#include "tests/bench/work_precision/tracking.hpp"

#include <memory>

#include "solver/linear/pivot_order.hpp"

namespace misalign::bench {
namespace {

// Steps of 10 degrees may turn a crease by as much as 60: what the solver's own approach to its
// threshold allows.
constexpr double kLongestHalfSine = 0.5;

}  // namespace

ProblemObserver::ProblemObserver(const Problem& problem, const Demand& demand, int lanes)
    : problem_(problem),
      elimination_(solver::plan_elimination(problem.mechanism(), problem.topology().folding,
                                            problem.topology().base_vertices_mm)),
      plan_(solver::plan_path(problem.mechanism(), problem.topology().folding,
                              problem.topology().base_vertices_mm,
                              {.sample_deg = static_cast<double>(demand.spacing_deg),
                               .end_deg = kEnd_deg,
                               .longest_step_deg = static_cast<double>(demand.spacing_deg)})),
      point_(problem.mechanism()),
      sheet_of_lane_(static_cast<std::size_t>(lanes)) {
  options_.closure_tolerance = demand.tolerance;
  if (demand.spacing_deg > 1) options_.longest_half_sine = kLongestHalfSine;
}

void ProblemObserver::begin(std::vector<Track>& tracks) {
  tracks_ = &tracks;
  next_ = 0;
  for (Track& track : tracks) {
    track.converged = false;
    track.effort = {};
    track.lengths.clear();
  }
}

bool ProblemObserver::next(solver::PathStart& start, int lane) {
  if (next_ == problem_.sheets().size()) return false;
  sheet_of_lane_[lane] = next_;
  start = {&problem_.sheets()[next_++].geometry, &plan_.start, &plan_};
  return true;
}

bool ProblemObserver::see(const solver::Station&, int lane) {
  std::vector<double>& lengths = (*tracks_)[sheet_of_lane_[lane]].lengths;
  lengths.insert(lengths.end(), point_.lengths.begin(), point_.lengths.end());
  return true;
}

// Every iteration evaluates and corrects.
void ProblemObserver::ended(const solver::PathResult& path, int lane) {
  Track& track = (*tracks_)[sheet_of_lane_[lane]];
  track.converged = path.end == solver::PathEnd::end_reached;
  track.effort = {path.newton_iterations, path.newton_iterations};
}

Run track_one_by_one(const Problem& problem, const Demand& demand) {
  auto tracking = std::make_shared<Tracking<double>>(problem, demand);
  return [tracking](std::vector<Track>& tracks) { tracking->follow(tracks); };
}

}  // namespace misalign::bench
