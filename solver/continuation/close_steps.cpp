#include "solver/continuation/close_steps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

// Angle beyond which solutions may be double: other branches cross where sheets fold flat. (They do
// at the flat sheet too, but there Newton's method is slow on the right branch.)
constexpr double kDoubleFrom_deg = 179;

}  // namespace

void CloseSteps::begin(const PathStart& start) {
  assert(start.first_station < start.plan->stations.size());
  assert(start.forward_sign >= -1 && start.forward_sign <= 1);
  plan_ = start.plan;
  station_ = start.first_station;
  phase_ = Phase::stepping;
  correction_.begin();
  kept_ = stations_ = arc_steps_ = 0;
  result_ = {};
  result_.forward_sign = start.forward_sign;
}

PathStep CloseSteps::after(const NewtonReport& report) {
  assert(plan_ && under_way());
  ++result_.newton_iterations;
  switch (correction_.after(report, correction(), kept_ == 0)) {
    case Correction::Now::goes_on:
      return {};
    case Correction::Now::closed:
      return is_free() ? found_on_arc(report) : converged(report);
    default:
      return not_there();
  }
}

Correction::Options CloseSteps::correction() const {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  if (is_free()) return {options_.closure_tolerance, 0, options_.max_corrections, kAny};
  if (phase_ == Phase::ahead) return {options_.closure_tolerance, 0, 0, kAny};
  const double start_rad = target().pilot_deg * kRadPerDeg;
  const bool may_be_double = target().pilot_deg > kDoubleFrom_deg;
  const double longest_rad = kept_ > 0       ? options_.longest_correction_rad
                             : start_rad > 0 ? options_.longest_start_share * start_rad
                                             : kAny;
  return {options_.closure_tolerance, kept_ > 0 ? options_.least_corrections : 0,
          options_.max_corrections, longest_rad,
          kept_ > 0 && phase_ != Phase::last_try && may_be_double ? options_.least_gain : 0};
}

double CloseSteps::longest_half_sine() const {
  return phase_ == Phase::last_try  ? options_.arc.longest_try_half_sine
         : phase_ == Phase::landing ? std::min(ds_, options_.longest_half_sine)
                                    : options_.longest_half_sine;
}

// Accepts a state with the pilot at the station and every loop closed if it lies on the path's own
// curve.
PathStep CloseSteps::converged(const NewtonReport& report) {
  ++result_.newton_solves;
  const double sign = report.tangent_pilot < 0 ? -1 : 1;
  if (phase_ == Phase::ahead) {
    PathStep step = arrive(report, sign);
    step.uncorrected = true;
    return step;
  }
  if (kept_ > 0 && !(report.largest_half_sine <= longest_half_sine())) return not_there();
  if (phase_ == Phase::last_try) return arrive(report, sign);
  int& forward_sign = result_.forward_sign;
  if (forward_sign == 0) forward_sign = report.determinant_sign();
  const double least_cosine = kept_ > 0 ? options_.least_tangent_cosine : 0;
  if (!is_own_curve(report, sign, forward_sign, least_cosine)) return not_there();
  return arrive(report, sign);
}

PathStep CloseSteps::arrive(const NewtonReport& report, double tangent_sign) {
  stations_ = phase_ == Phase::stepping ? std::min(stations_ + 1, kNodes) : 1;
  note(report, std::abs(report.tangent_pilot));
  phase_ = Phase::stepping;
  result_.fold_limit_deg = target().pilot_deg;
  PathStep step;
  step.keep = step.arrived = true;
  step.tangent_sign = tangent_sign;
  return step;
}

void CloseSteps::note(const NewtonReport& report, double rate) {
  nodes_[kept_++ % kStatePlaces] = {report.pilot, target().pilot_deg * kRadPerDeg, rate};
}

// Extrapolates by the rates of change at the last stations, dx/dpilot = tangent / its pilot entry.
PathStep CloseSteps::proceed() {
  assert(phase_ == Phase::stepping && stations_ > 0);
  if (++station_ == plan_->stations.size()) return end(PathEnd::end_reached);
  correction_.begin();
  double at_rad[kNodes], rates[kNodes];
  for (int k = 0; k < stations_; ++k) {
    at_rad[k] = node(newest() - k).at_rad;
    rates[k] = node(newest() - k).rate;
  }
  PathStep step;
  step.extrapolate(at_rad, rates, stations_, newest(), false, target().pilot_deg * kRadPerDeg);
  step.hold = true;
  step.pilot = target().pilot;
  return step;
}

PathStep CloseSteps::not_there() {
  if (phase_ == Phase::stepping) return begin_arc();
  if (phase_ == Phase::ahead) return try_station(newest());
  if (phase_ == Phase::last_try) return end(result_.end);
  ds_ *= 0.5;
  phase_ = Phase::arc;
  return go_along();
}

PathStep CloseSteps::begin_arc() {
  if (kept_ == 0) return end(PathEnd::start_lost);
  phase_ = Phase::arc;
  arc_steps_ = 0;
  bend_ = 0;
  ds_ = std::min(options_.arc.longest_step_rad, 0.5 * gap_rad(newest()) / last().rate);
  return go_along();
}

// Takes the next step along the arc from the last accepted point.
PathStep CloseSteps::go_along() {
  assert(phase_ == Phase::arc);
  ++arc_steps_;
  ++result_.arc_steps;
  const double rise = ds_ * last().rate;
  if (bend_ > 0 && rise < options_.arc.limit_tolerance_rad) return at_limit_point(rise);
  if (ds_ < options_.arc.shortest_step_rad || arc_steps_ > options_.arc.most_steps) {
    result_.fold_limit_deg = angle_deg(last().pilot);
    return no_way_on(PathEnd::stalled);
  }
  correction_.begin();
  PathStep step;
  step.go_along(newest(), ds_);
  return step;
}

// Judges a point of the curve that was found with the pilot free.
PathStep CloseSteps::found_on_arc(const NewtonReport& report) {
  const double sign = report.tangent_cosine < 0 ? -1 : 1;
  if (!is_own_curve(report, sign, result_.forward_sign, options_.arc.least_tangent_cosine)) {
    return not_there();
  }
  if (half_sine_between(report.pilot, target().pilot) >= 0) {
    phase_ = Phase::landing;
    correction_.begin();
    PathStep step;
    step.go_along(newest(), ds_ * half_sine_between(target().pilot, last().pilot) /
                                half_sine_between(report.pilot, last().pilot));
    step.hold = true;
    step.pilot = target().pilot;
    return step;
  }
  const double tangent_pilot = sign * report.tangent_pilot;
  if (tangent_pilot <= 0) {
    const double before = last().rate;
    const double rise = ds_ * std::max(before, -tangent_pilot);
    if (rise < options_.arc.limit_tolerance_rad) return at_limit_point(rise);
    bend_ = (before - tangent_pilot) / ds_;
    ds_ = std::clamp(before / bend_, 0.1 * ds_, 0.9 * ds_);
    return go_along();
  }
  ds_ = next_along_arc(tangent_pilot);
  note(report, tangent_pilot);
  PathStep step = go_along();
  step.keep = true;
  step.tangent_sign = sign;
  return step;
}

// Length of the next step: to the limit point if one was passed; else at most to where the pilot's
// falling rate would vanish, lest two limit points close together are stepped over.
double CloseSteps::next_along_arc(double tangent_pilot) const {
  if (bend_ > 0) return tangent_pilot / bend_;
  const double longest = std::min(1.5 * ds_, options_.arc.longest_step_rad);
  const double falls_by = (last().rate - tangent_pilot) / ds_;
  if (!(falls_by > 0)) return longest;
  return std::min(longest, std::max(tangent_pilot / falls_by, options_.arc.least_step_by_fall_rad));
}

// Ends at a limit point at most `rise_rad` above the last accepted point.
PathStep CloseSteps::at_limit_point(double rise_rad) {
  result_.fold_limit_deg = angle_deg(last().pilot) + 0.5 * rise_rad / kRadPerDeg;
  return no_way_on(PathEnd::fold_limit);
}

// Ends the path, unless the station lies next to the last accepted point and has a solution after
// all: along the tangent of a slightly older node, or by Newton's method from the newest.
PathStep CloseSteps::no_way_on(PathEnd why) {
  result_.end = why;
  const double gap = gap_rad(newest());
  if (!(gap > 0 && gap <= options_.arc.singular_gap_rad)) return end(why);
  int from = newest();
  const int oldest = std::max(0, newest() - kStatePlaces + 1);
  while (from > oldest && gap_rad(from) < options_.arc.try_from_rad) --from;
  return try_station(from);
}

PathStep CloseSteps::try_station(int from) {
  phase_ = from < newest() ? Phase::ahead : Phase::last_try;
  correction_.begin();
  PathStep step;
  step.go_along(from, from < newest() ? gap_rad(from) / node(from).rate : 0);
  step.hold = true;
  step.pilot = target().pilot;
  return step;
}

// Pilot angle from node k to the station.
double CloseSteps::gap_rad(int k) const {
  return 2 * half_sine_between(target().pilot, node(k).pilot);
}

PathStep CloseSteps::end(PathEnd end) {
  result_.end = end;
  phase_ = Phase::idle;
  PathStep step;
  step.ended = true;
  return step;
}

}  // namespace misalign::solver
