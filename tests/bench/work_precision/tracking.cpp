#include "tests/bench/work_precision/tracking.hpp"

#include <memory>

#include "solver/linear/pivot_order.hpp"

namespace misalign::bench {
namespace {

// Steps of 10 degrees may turn a crease by as much as 60: what the rejection tests'
// own steps ahead allow.
constexpr double kLongestHalfSine = 0.5;

// As in production: what is not believed any more, of what is wanted.
constexpr double kMostOfWanted = 10;

template <class Tracking>
Run made_ready(const Problem& problem, const Demand& demand) {
  auto tracking = std::make_shared<Tracking>(problem, demand);
  return [tracking](std::vector<Track>& tracks) { tracking->follow(tracks); };
}

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
      sheet_of_lane_(static_cast<std::size_t>(lanes)) {}

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

// Every iteration evaluates and corrects.
void ProblemObserver::ended(const solver::PathResult& path, int lane) {
  track(lane).converged = path.end == solver::PathEnd::end_reached;
  track(lane).effort = {path.newton_iterations, path.newton_iterations};
}

StationObserver::StationObserver(const Problem& problem, const Demand& demand, int lanes)
    : ProblemObserver(problem, demand, lanes), point_(problem.mechanism()) {
  options_.closure_tolerance = demand.tolerance;
  if (demand.spacing_deg > 1) options_.longest_half_sine = kLongestHalfSine;
}

bool StationObserver::see(const solver::Station&, int lane) {
  std::vector<double>& lengths = track(lane).lengths;
  lengths.insert(lengths.end(), point_.lengths.begin(), point_.lengths.end());
  return true;
}

FunctionObserver::FunctionObserver(const Problem& problem, const Demand& demand, int lanes)
    : ProblemObserver(problem, demand, lanes),
      diagonals_(static_cast<std::size_t>(problem.diagonals())),
      estimate_(problem.mechanism()) {
  options_.wanted_roughness = demand.tolerance;
  options_.most_roughness = kMostOfWanted * demand.tolerance;
}

solver::ObserverResult FunctionObserver::see(const solver::PathFunction& function, int lane) {
  std::vector<double>& lengths = track(lane).lengths;
  const double end_rad = function.pilot(function.end());
  for (std::size_t k = lengths.size() / diagonals_; k < plan_.stations.size(); ++k) {
    const double pilot_rad = plan_.stations[k].pilot_deg * solver::kRadPerDeg;
    if (pilot_rad > end_rad + 1e-12) break;
    function.look(function.locate(pilot_rad), estimate_);
    lengths.insert(lengths.end(), estimate_.lengths.begin(), estimate_.lengths.end());
  }
  return solver::ObserverResult::go_on;
}

Run track_one_by_one(const Problem& problem, const Demand& demand) {
  return made_ready<StationTracking<double>>(problem, demand);
}

Run functions_one_by_one(const Problem& problem, const Demand& demand) {
  return made_ready<FunctionTracking<double>>(problem, demand);
}

}  // namespace misalign::bench
