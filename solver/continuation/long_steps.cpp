#include "solver/continuation/long_steps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {
namespace {

// Factor by which the first step multiplies the pilot's angle.
constexpr double kFirstGrowth = 3;
// A failed step is shortened by the first factor; a step is at most the second times the last.
constexpr double kShorter = 0.4, kLonger = 2;
// Share of the step length that follows from the last step's errors.
constexpr double kCaution = 0.9;

// Largest number of nodes solved for one limit point.
constexpr int kMostLimitNodes = 3;

// Returns whether flat counts among the nodes of an extrapolation.
bool counts_flat(const PathFunction& function) {
  return function.count() < kStateNodes && function.from_flat();
}
static_assert(PathFunction::kNodes == kStateNodes + 1);  // choose_step counts on it

double distance_to_nodes(const PathFunction& function, double x) {
  double product = 1;
  const int count = std::min(function.kept(), kStateNodes);
  for (int k = 0; k < count; ++k) product *= (x - function.at(k)) * (x - function.at(k));
  if (counts_flat(function)) product *= x;
  return product;
}

// The n-th root within 1e-4, enough for a step's length: a Newton step from an estimate by
// logarithms. It is written out, since the last bits of the C library's powers differ by processor.
double root_of(double x, int n) {
  int exponent = 0;
  const double lacks = 1 - std::frexp(std::clamp(x, 1e-290, 1e290), &exponent);  // (0, 0.5]
  const double logarithm = (exponent - lacks * (1.36 + 1.28 * lacks)) / n;
  const double whole = std::floor(logarithm), part = logarithm - whole;
  const double root = std::ldexp(1 + part * (0.6565 + 0.3435 * part), static_cast<int>(whole));
  double power = 1;
  for (int factor = 1; factor < n; ++factor) power *= root;
  return root - (root - x / power) / n;
}

}  // namespace

LongSteps::LongSteps(const Mechanism& mechanism, const Options& options)
    : mechanism_(mechanism),
      pilot_(mechanism.pilot),
      options_(options),
      flat_(mechanism.diagonals.size()),
      function_(mechanism) {}

LongSteps::~LongSteps() = default;
LongSteps::LongSteps(const LongSteps&) = default;

void LongSteps::begin(const PathStart& start) {
  assert(start.first_station < start.plan->stations.size());
  flat_lengths(mechanism_, *start.geometry, flat_.data());
  plan_ = start.plan;
  function_.begin(flat_.data());
  result_ = {};
  correction_.begin();
  is_free_ = to_limit_ = false;
  limit_nodes_ = 0;
  start_rad_ = start.plan->stations[start.first_station].pilot_deg * kRadPerDeg;
}

PathStep LongSteps::after(const NewtonReport& report) {
  ++result_.newton_iterations;
  const bool is_first = function_.count() == 0;
  const Correction::Options correction{
      Newton::Options{}.closure_tolerance, 0, (is_first ? 2 : 1) * options_.max_corrections,
      is_first ? kLongestStartShare * start_rad_ : options_.longest_correction_rad};
  const Correction::Now now = correction_.after(report, correction, is_first);
  if (now == Correction::Now::goes_on) return {};
  if (now == Correction::Now::given_up) return retry();
  ++result_.newton_solves;
  PathStep step;
  step.arrived = true;
  step.tangent_sign = (is_first ? report.tangent_pilot : report.tangent_cosine) < 0 ? -1 : 1;
  if (is_first) result_.forward_sign = report.determinant_sign();
  const double least_cosine = is_first ? 0 : options_.least_tangent_cosine;
  return is_own_curve(report, step.tangent_sign, result_.forward_sign, least_cosine) ? step
                                                                                     : retry();
}

bool LongSteps::take() {
  to_limit_ ? function_.add_at_turn() : function_.add();
  if (function_.count() == 1) return true;
  return function_.roughness() <= options_.most_roughness && function_.to() > function_.from() &&
         function_.pilot_goes_on();
}

PathStep LongSteps::take_back() {
  assert(function_.count() > 0);
  function_.drop();
  return retry();
}

bool LongSteps::ends_segment() const {
  if (!function_.turns()) return true;
  // The rise from a node next to the turn follows from the pilot's rate and curvature there, which
  // is known to a hundredth.
  return function_.has_node_at_turn()
             ? function_.pilot_rise() <= 100 * options_.limit_tolerance_rad
             : function_.pilot_error(function_.end()) <= options_.limit_tolerance_rad;
}

PathStep LongSteps::proceed() {
  const Station& last = plan_->stations.back();
  if (function_.turns()) {
    const double turn = function_.end();
    result_.fold_limit_deg = function_.pilot(turn) / kRadPerDeg;
    if (std::min(result_.fold_limit_deg, last.pilot_deg) > options_.last_deg) {
      return end(PathEnd::stalled);
    }
    if (result_.fold_limit_deg >= last.pilot_deg) {
      result_.fold_limit_deg = last.pilot_deg;
      return end(PathEnd::end_reached);
    }
    if (ends_segment()) return end(PathEnd::fold_limit);
    if (++limit_nodes_ > kMostLimitNodes) return end(PathEnd::stalled);
    to_limit_ = is_free_ = true;
    correction_.begin();
    return state_at(turn);
  }
  const double here_deg = angle_deg(function_.node(0).creases[pilot_]);
  result_.fold_limit_deg = std::min(here_deg, last.pilot_deg);
  if (std::min(here_deg, last.pilot_deg) > options_.last_deg) return end(PathEnd::stalled);
  if (here_deg >= last.pilot_deg - kSameAngle_deg) return end(PathEnd::end_reached);
  choose_step();
  return depart();
}

void LongSteps::choose_step() {
  const double x = function_.at(0);
  if (function_.count() == 1) {
    step_ = (kFirstGrowth - 1) * x;
    return;
  }
  const double last = function_.to() - function_.from();
  double step = kLonger * last;
  // The extrapolation's error is a constant times the product of the distances to its nodes: those
  // before the newest, and flat while there were fewer than kStateNodes.
  double distance = function_.from_flat() ? x : 1;
  const int before = std::min(function_.kept() - 1, kStateNodes);
  for (int k = 1; k <= before; ++k) distance *= (x - function_.at(k)) * (x - function_.at(k));
  const double share =
      options_.wanted_correction_rad / std::max(correction_.first_rad(), 1e-12) * distance;
  const int order = 2 * std::min(function_.kept(), kStateNodes);
  for (int k = 0; k < 4; ++k) {
    const double off = distance_to_nodes(function_, x + step) / share;
    step /= root_of(off, order);
  }
  const double rough = std::max(function_.roughness(), 1e-15);
  const double by_roughness =
      last * root_of(options_.wanted_roughness / rough, 2 * function_.kept() - 2);
  step_ = std::min(
      {kCaution * step, kCaution * by_roughness, kLonger * last, options_.longest_step_rad});
}

PathStep LongSteps::depart() {
  correction_.begin();
  to_limit_ = false;
  is_free_ = function_.variable() != pilot_;
  double x = function_.at(0) + step_;
  const Station* target = nullptr;
  if (!is_free_) {
    const auto& stations = plan_->stations;
    const double x_deg = x / kRadPerDeg, here_deg = result_.fold_limit_deg;
    const auto next = std::upper_bound(
        stations.begin(), stations.end(), x_deg + kSameAngle_deg,
        [](double angle_deg, const Station& station) { return angle_deg < station.pilot_deg; });
    if (next != stations.begin() && std::prev(next)->pilot_deg > here_deg + kSameAngle_deg) {
      target = &*std::prev(next);
      x = target->pilot_deg * kRadPerDeg;
    } else {
      is_free_ = true;
    }
  }
  PathStep step = state_at(x);
  if (target) {
    step.hold = true;
    step.pilot = target->pilot;
  }
  return step;
}

PathStep LongSteps::retry() {
  if (function_.count() == 0) return end(PathEnd::start_lost);
  step_ *= kShorter;
  if (to_limit_ || !(step_ > options_.shortest_step_rad)) return end(PathEnd::stalled);
  return depart();
}

PathStep LongSteps::end(PathEnd how) {
  result_.end = how;
  plan_ = nullptr;
  PathStep step;
  step.ended = true;
  return step;
}

PathStep LongSteps::state_at(double x) const {
  const int count = std::min(function_.kept(), kStateNodes);
  double at[kStateNodes], rates[kStateNodes];
  for (int k = 0; k < count; ++k) {
    at[k] = function_.at(k);
    rates[k] = function_.variable_rate(k);
  }
  PathStep step;
  step.extrapolate(at, rates, count, newest(), counts_flat(function_), x);
  return step;
}

}  // namespace misalign::solver
