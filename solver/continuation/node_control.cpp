#include "solver/continuation/node_control.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// The first step multiplies the pilot's angle by this.
constexpr double kFirstGrowth = 3;
// A step that failed is shortened to this share, and the next one is longer than the last by this
// factor at most.
constexpr double kShorter = 0.4, kLonger = 2;
// Of what the last step's errors foretell for the next.
constexpr double kCaution = 0.9;

// Nodes that are solved for the sake of one limit point.
constexpr int kMostLimitNodes = 3;

// Whether a state is extrapolated from flat as well.
bool counts_flat(const PathFunction& function) {
  return function.count() < kStateNodes && function.from_flat();
}
static_assert(PathFunction::kNodes == kStateNodes + 1);  // choose_step counts on it

}  // namespace

NodeControl::NodeControl(const Mechanism& mechanism, int lanes, const NodeControlOptions& options)
    : mechanism_(mechanism),
      pilot_(mechanism.pilot),
      options_(options),
      flat_(mechanism.diagonals.size()),
      paths_(static_cast<std::size_t>(lanes), Path{.function = PathFunction(mechanism)}) {}

NodeControl::~NodeControl() = default;

void NodeControl::begin(const PathStart& start, int lane) {
  flat_lengths(mechanism_, *start.geometry, flat_.data());
  assert(start.first_station < start.plan->stations.size());
  Path& path = paths_[lane];
  path.plan = start.plan;
  path.function.begin(flat_.data());
  path.result = {};
  path.is_free = path.to_limit = false;
  path.limit_nodes = 0;
  path.forward_sign = path.corrections = 0;
  path.corrected_rad = path.last_open = 0;
  path.target_deg = start.plan->stations[start.first_station].pilot_deg;
}

NodeStep NodeControl::after(const NewtonReport& report, int lane) {
  Path& path = paths_[lane];
  ++path.result.newton_iterations;
  const bool is_first = path.function.count() == 0;
  const bool is_finite = std::isfinite(report.open_by) && std::isfinite(report.tangent_pilot);
  if (path.corrections == 0) path.first_correction_rad = report.correction_rad;
  path.corrected_rad += report.correction_rad;
  if (!is_finite) return retry(path);
  if (!(report.open_by <= NewtonOptions{}.closure_tolerance)) {
    const bool grows = path.corrections > 1 && !(report.open_by < path.last_open);
    path.last_open = report.open_by;
    const int most = is_first ? 2 * options_.max_corrections : options_.max_corrections;
    if (grows || path.corrections == most ||
        (!is_first && path.corrected_rad > options_.longest_correction_rad)) {
      return retry(path);
    }
    ++path.corrections;
    return {};
  }
  ++path.result.newton_solves;
  if (is_first) {
    if (path.corrected_rad >
        StepControlOptions{}.longest_start_share * path.target_deg * kRadPerDeg) {
      return retry(path);
    }
    path.forward_sign = report.determinant_sign;
    path.tangent_sign = report.tangent_pilot < 0 ? -1 : 1;
  } else {
    path.tangent_sign = report.tangent_cosine < 0 ? -1 : 1;
    if (path.corrected_rad > options_.longest_correction_rad ||
        !(std::abs(report.tangent_cosine) >= options_.least_tangent_cosine) ||
        report.orientation * path.tangent_sign != path.forward_sign) {
      return retry(path);
    }
  }
  NodeStep step;
  step.arrived = true;
  return step;
}

bool NodeControl::take(int lane) {
  Path& path = paths_[lane];
  path.to_limit ? path.function.add_at_turn() : path.function.add();
  if (path.function.count() == 1) return true;
  return path.function.roughness() <= options_.most_roughness &&
         path.function.to() > path.function.from() && path.function.pilot_goes_on();
}

NodeStep NodeControl::take_back(int lane) {
  assert(paths_[lane].function.count() > 0);
  paths_[lane].function.drop();
  return retry(paths_[lane]);
}

bool NodeControl::ends_segment(int lane) const {
  assert(lane >= 0 && static_cast<std::size_t>(lane) < paths_.size());
  const PathFunction& function = paths_[lane].function;
  if (!function.turns()) return true;
  // From a node next to the turn the rise follows from its rate and the bend of the pilot's angle,
  // which is known to a hundredth.
  return function.has_node_at_turn()
             ? function.pilot_rise() <= 100 * options_.limit_tolerance_rad
             : function.pilot_error(function.end()) <= options_.limit_tolerance_rad;
}

NodeStep NodeControl::proceed(int lane) {
  Path& path = paths_[lane];
  const PathFunction& function = path.function;
  const Station& last = path.plan->stations.back();
  if (function.turns()) {
    const double turn = function.end();
    path.result.fold_limit_deg = function.pilot(turn) / kRadPerDeg;
    if (std::min(path.result.fold_limit_deg, last.pilot_deg) > options_.last_deg) {
      return end(path, PathEnd::stalled);
    }
    if (path.result.fold_limit_deg >= last.pilot_deg) {
      path.result.fold_limit_deg = last.pilot_deg;
      return end(path, PathEnd::end_reached);
    }
    if (ends_segment(lane)) return end(path, PathEnd::fold_limit);
    if (++path.limit_nodes > kMostLimitNodes) return end(path, PathEnd::stalled);
    path.to_limit = path.is_free = true;
    path.corrections = 0;
    path.corrected_rad = 0;
    NodeStep step = weights(path, turn);
    step.depart = true;
    return step;
  }
  const double here_deg = angle_deg(function.node(0).creases[pilot_]);
  path.result.fold_limit_deg = std::min(here_deg, last.pilot_deg);
  if (std::min(here_deg, last.pilot_deg) > options_.last_deg) return end(path, PathEnd::stalled);
  if (here_deg >= last.pilot_deg - 1e-9) return end(path, PathEnd::end_reached);
  choose_step(path);
  return depart(path);
}

double NodeControl::distance_to_nodes(const PathFunction& function, double x) {
  double product = 1;
  const int count = std::min(function.kept(), kStateNodes);
  for (int k = 0; k < count; ++k) product *= (x - function.at(k)) * (x - function.at(k));
  if (counts_flat(function)) product *= x;
  return product;
}

void NodeControl::choose_step(Path& path) {
  const PathFunction& function = path.function;
  const double here = function.at(0);
  if (function.count() == 1) {
    path.step = (kFirstGrowth - 1) * here;
    return;
  }
  const double last = function.to() - function.from();
  double step = kLonger * last;
  // The extrapolation's error is a constant times the product of the distances to its nodes: those
  // before the newest, and flat as long as they were fewer than kStateNodes.
  double distance = function.from_flat() ? here : 1;
  const int before = std::min(function.kept() - 1, kStateNodes);
  for (int k = 1; k <= before; ++k) distance *= (here - function.at(k)) * (here - function.at(k));
  const double share =
      options_.wanted_correction_rad / std::max(path.first_correction_rad, 1e-12) * distance;
  const int order = 2 * std::min(function.kept(), kStateNodes);
  for (int k = 0; k < 4; ++k) {
    const double off = distance_to_nodes(function, here + step) / share;
    step *= std::pow(off, -1.0 / order);
  }
  const double rough = std::max(function.roughness(), 1e-15);
  const double by_roughness =
      last * std::pow(options_.wanted_roughness / rough, 1.0 / (2 * function.kept() - 2));
  path.step = std::min(
      {kCaution * step, kCaution * by_roughness, kLonger * last, options_.longest_step_rad});
}

NodeStep NodeControl::depart(Path& path) {
  const PathFunction& function = path.function;
  path.corrections = 0;
  path.corrected_rad = 0;
  path.to_limit = false;
  path.is_free = function.variable() != pilot_;
  double x = function.at(0) + path.step;
  NodeStep step;
  const Station* target = nullptr;
  if (!path.is_free) {
    const auto& stations = path.plan->stations;
    const double x_deg = x / kRadPerDeg, here_deg = path.result.fold_limit_deg;
    const auto next = std::upper_bound(
        stations.begin(), stations.end(), x_deg + 1e-9,
        [](double angle_deg, const Station& station) { return angle_deg < station.pilot_deg; });
    if (next != stations.begin() && std::prev(next)->pilot_deg > here_deg + 1e-9) {
      target = &*std::prev(next);
      x = target->pilot_deg * kRadPerDeg;
    } else {
      path.is_free = true;
    }
  }
  step = weights(path, x);
  step.depart = true;
  if (target) {
    step.hold = true;
    step.pilot = target->pilot;
  }
  return step;
}

NodeStep NodeControl::retry(Path& path) {
  if (path.function.count() == 0) return end(path, PathEnd::start_lost);
  path.step *= kShorter;
  if (path.to_limit || !(path.step > options_.shortest_step_rad)) {
    return end(path, PathEnd::stalled);
  }
  return depart(path);
}

NodeStep NodeControl::end(Path& path, PathEnd how) {
  path.result.end = how;
  path.plan = nullptr;
  NodeStep step;
  step.ended = true;
  return step;
}

NodeStep NodeControl::state_at(double x, int lane) const { return weights(paths_[lane], x); }

NodeStep NodeControl::weights(const Path& path, double x) const {
  const PathFunction& function = path.function;
  const int count = std::min(function.kept(), kStateNodes);
  const double origin = 0;
  const bool from_flat = counts_flat(function);
  double nodes[kStateNodes], of_values[kStateNodes], of_rates[kStateNodes];
  for (int k = 0; k < count; ++k) nodes[k] = function.at(k);
  NodeStep step;
  hermite_weights(nodes, count, from_flat ? &origin : nullptr, x, of_values, of_rates,
                  &step.of_flat);
  for (int k = 0; k < count; ++k) {
    const int place = (function.count() - 1 - k) % kStatePlaces;
    step.of_values[place] = of_values[k];
    step.of_rates[place] = of_rates[k] / function.variable_rate(k);
  }
  return step;
}

}  // namespace misalign::solver
