#include "solver/continuation/step_control.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace misalign::solver {

void StepControl::begin(const PathPlan& plan, std::size_t first_station, int forward_sign) {
  assert(first_station < plan.stations.size());
  assert(forward_sign >= -1 && forward_sign <= 1);
  plan_ = &plan;
  station_ = first_station;
  phase_ = Phase::stepping;
  forward_sign_ = forward_sign;
  corrections_ = tangents_ = arc_steps_ = 0;
  corrected_rad_ = 0;
  result_ = {};
}

PathStep StepControl::after(const NewtonReport& report) {
  assert(plan_ && phase_ != Phase::idle);  // begun, and not ended
  ++result_.newton_iterations;
  // Where a coordinate or a pivot is no number the tangent is none; the residual's and the
  // corrections' largest entries may hide it.
  const bool is_finite = std::isfinite(report.open_by) && std::isfinite(report.tangent_pilot);
  const bool is_closed = is_finite && report.open_by <= (on_arc() ? options_.arc_closure_tolerance
                                                                  : options_.closure_tolerance);
  // Near flat a first step from the base folding closes the loops better than its error in the
  // joints lets the second: that one may open them again on the way to the solution.
  const bool grows = corrections_ > (tangents_ > 0 ? 1 : 2) && !(report.open_by < last_open_);
  last_open_ = report.open_by;
  corrected_rad_ += report.correction_rad;
  if (is_closed) return phase_ == Phase::arc ? found_on_arc(report) : converged(report);
  if (grows || !is_finite || corrections_ == options_.max_corrections) {
    return not_there(report);
  }
  ++corrections_;
  return {};
}

// The pilot is at the station and every loop closes: believed if it is still the path's own curve.
PathStep StepControl::converged(const NewtonReport& report) {
  ++result_.newton_solves;
  const double longest_turn = phase_ == Phase::last_try  ? options_.arc.longest_try_half_sine
                              : phase_ == Phase::landing ? std::min(ds_, options_.longest_half_sine)
                                                         : options_.longest_half_sine;
  if (!(report.largest_half_sine <= longest_turn)) return not_there(report);
  if (phase_ == Phase::last_try) return arrive(report, report.tangent_pilot < 0 ? -1 : 1);
  if (tangents_ == 0 && target().pilot_deg > 0 &&
      corrected_rad_ > options_.longest_start_share * target().pilot_deg * kRadPerDeg) {
    return not_there(report);
  }
  if (tangents_ > 0 && (corrected_rad_ > options_.longest_correction_rad ||
                        !(std::abs(report.tangent_cosine) >= options_.least_tangent_cosine))) {
    return not_there(report);
  }
  if (forward_sign_ == 0) forward_sign_ = report.determinant_sign;
  if (report.determinant_sign != forward_sign_) return not_there(report);
  return arrive(report, report.tangent_pilot < 0 ? -1 : 1);
}

PathStep StepControl::arrive(const NewtonReport& report, double tangent_sign) {
  const double step_rad =
      tangents_ > 0 ? (target().pilot_deg - result_.fold_limit_deg) * kRadPerDeg : 0;
  if (phase_ != Phase::stepping) tangents_ = 0;
  phase_ = Phase::stepping;
  result_.fold_limit_deg = target().pilot_deg;
  tangent_pilot_[2] = std::exchange(tangent_pilot_[1], tangent_pilot_[0]);
  tangent_pilot_[0] = std::abs(report.tangent_pilot);
  step_rad_[1] = std::exchange(step_rad_[0], step_rad);
  tangents_ = std::min(tangents_ + 1, 3);
  PathStep move;
  move.believe = move.arrived = true;
  move.tangent_sign = tangent_sign;
  return move;
}

// Extrapolates with the rates of change at the last stations, dx/dpilot = tangent / its pilot
// entry, integrated as a polynomial through up to three of them (Adams-Bashforth, unequal steps).
PathStep StepControl::proceed() {
  assert(phase_ == Phase::stepping && tangents_ > 0);
  if (++station_ == plan_->stations.size()) return end(PathEnd::end_reached);
  corrections_ = 0;
  corrected_rad_ = 0;
  const double h = (target().pilot_deg - result_.fold_limit_deg) * kRadPerDeg;
  const double h1 = step_rad_[0], h2 = step_rad_[1];
  double weight[3] = {h, 0, 0};
  if (tangents_ >= 2) {
    const double bend = 0.5 * h * h / h1;
    weight[0] += bend;
    weight[1] -= bend;
  }
  if (tangents_ == 3) {
    const double twist = (h / 3 + h1 / 2) * h * h / (h1 + h2);
    weight[0] += twist / h1;
    weight[1] -= twist / h1 + twist / h2;
    weight[2] += twist / h2;
  }
  PathStep move;
  move.depart = move.hold = true;
  for (int k = 0; k < 3; ++k) move.along[k] = weight[k] / tangent_pilot_[k];
  move.pilot = target().pilot;
  return move;
}

PathStep StepControl::not_there(const NewtonReport& report) {
  if (phase_ == Phase::stepping) return begin_arc(report);
  if (phase_ == Phase::last_try) return end(result_.end);
  ds_ *= 0.5;
  phase_ = Phase::arc;
  return go_along(report.last_pilot);
}

PathStep StepControl::begin_arc(const NewtonReport& report) {
  if (tangents_ == 0) return end(PathEnd::start_lost);
  phase_ = Phase::arc;
  arc_steps_ = 0;
  bend_ = 0;
  const double gap = 2 * half_sine_between(target().pilot, report.last_pilot);
  ds_ = std::min(options_.arc.longest_step_rad, 0.5 * gap / tangent_pilot_[0]);
  return go_along(report.last_pilot);
}

// The next step along the arc from the last point believed.
PathStep StepControl::go_along(const HalfAngle<double>& last_pilot) {
  assert(phase_ == Phase::arc);
  ++arc_steps_;
  ++result_.arc_steps;
  const double rise = ds_ * tangent_pilot_[0];
  if (bend_ > 0 && rise < options_.arc.limit_tolerance_rad) return at_limit_point(rise, last_pilot);
  if (ds_ < options_.arc.shortest_step_rad || arc_steps_ > options_.arc.most_steps) {
    result_.fold_limit_deg = angle_deg(last_pilot);
    return no_way_on(PathEnd::stalled, last_pilot);
  }
  corrections_ = 0;
  corrected_rad_ = 0;
  PathStep move;
  move.depart = true;
  move.along[0] = ds_;
  return move;
}

// A point of the curve was found with the pilot free.
PathStep StepControl::found_on_arc(const NewtonReport& report) {
  const double sign = report.tangent_cosine < 0 ? -1 : 1;
  const bool same_curve = report.orientation * sign == forward_sign_ &&
                          sign * report.tangent_cosine >= options_.arc.least_tangent_cosine;
  if (!same_curve) return not_there(report);
  if (half_sine_between(report.pilot, target().pilot) >= 0) {
    phase_ = Phase::landing;
    corrections_ = 0;
    corrected_rad_ = 0;
    PathStep move;
    move.depart = move.hold = true;
    move.along[0] = ds_ * half_sine_between(target().pilot, report.last_pilot) /
                    half_sine_between(report.pilot, report.last_pilot);
    move.pilot = target().pilot;
    return move;
  }
  const double tangent_pilot = sign * report.tangent_pilot;
  if (tangent_pilot <= 0) {
    const double before = tangent_pilot_[0];
    const double rise = ds_ * std::max(before, -tangent_pilot);
    const double way_left = 2 * half_sine_between(plan_->stations.back().pilot, report.last_pilot);
    if (rise <
        std::max(options_.arc.limit_tolerance_rad, (1 - options_.limit_certain_share) * way_left)) {
      return at_limit_point(rise, report.last_pilot);
    }
    bend_ = (before - tangent_pilot) / ds_;
    ds_ = std::clamp(before / bend_, 0.1 * ds_, 0.9 * ds_);
    return go_along(report.last_pilot);
  }
  ds_ = next_along_arc(tangent_pilot);
  tangent_pilot_[0] = tangent_pilot;
  PathStep move = go_along(report.pilot);
  move.believe = true;
  move.tangent_sign = sign;
  return move;
}

// Towards a limit point that was seen. Elsewhere no farther than to where the pilot's rate would
// vanish if it went on falling: two limit points close together might be stepped over.
double StepControl::next_along_arc(double tangent_pilot) const {
  if (bend_ > 0) return tangent_pilot / bend_;
  const double longest = std::min(1.5 * ds_, options_.arc.longest_step_rad);
  const double falls_by = (tangent_pilot_[0] - tangent_pilot) / ds_;
  if (!(falls_by > 0)) return longest;
  return std::min(longest, std::max(tangent_pilot / falls_by, options_.arc.least_step_by_fall_rad));
}

// Between the last point believed and the one that rises by at most `rise_rad` more.
PathStep StepControl::at_limit_point(double rise_rad, const HalfAngle<double>& last_pilot) {
  result_.fold_limit_deg = angle_deg(last_pilot) + 0.5 * rise_rad / kRadPerDeg;
  return no_way_on(PathEnd::fold_limit, last_pilot);
}

// Unless the station is next to the last point believed, and has a solution after all.
PathStep StepControl::no_way_on(PathEnd why, const HalfAngle<double>& last_pilot) {
  result_.end = why;
  const double gap_rad = 2 * half_sine_between(target().pilot, last_pilot);
  if (!(gap_rad > 0 && gap_rad <= options_.arc.singular_gap_rad)) return end(why);
  phase_ = Phase::last_try;
  corrections_ = 0;
  corrected_rad_ = 0;
  PathStep move;
  move.depart = move.hold = true;
  move.pilot = target().pilot;
  return move;
}

PathStep StepControl::end(PathEnd end) {
  result_.end = end;
  phase_ = Phase::idle;
  PathStep move;
  move.ended = true;
  return move;
}

}  // namespace misalign::solver
