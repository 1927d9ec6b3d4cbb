#include "solver/continuation/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace misalign::solver {

void Course::begin(const PathPlan& plan, std::size_t first_stop, int forward_sign) {
  plan_ = &plan;
  stop_ = first_stop;
  phase_ = Phase::stepping;
  forward_sign_ = forward_sign;
  corrections_ = tangents_ = walk_steps_ = 0;
  corrected_rad_ = 0;
  result_ = {};
}

Move Course::after(const Reading& reading) {
  ++result_.newton_iterations;
  // Where a coordinate or a pivot is no number the tangent is none; the residual's and the
  // corrections' largest entries may hide it.
  const bool is_finite = std::isfinite(reading.open_by) && std::isfinite(reading.tangent_pilot);
  const bool is_closed =
      is_finite &&
      reading.open_by <= (walking() ? options_.walk_closure_tolerance : options_.closure_tolerance);
  // Near flat a first step from the base folding closes the loops better than its error in the
  // joints lets the second: that one may open them again on the way to the solution.
  const bool grows = corrections_ > (tangents_ > 0 ? 1 : 2) && !(reading.open_by < last_open_);
  last_open_ = reading.open_by;
  corrected_rad_ += reading.correction_rad;
  if (is_closed) return phase_ == Phase::walking ? walked(reading) : converged(reading);
  if (grows || !is_finite || corrections_ == options_.max_corrections) {
    return not_there(reading);
  }
  ++corrections_;
  return {};
}

// The pilot is at the stop and every loop closes: believed if it is still the path's own curve.
Move Course::converged(const Reading& reading) {
  ++result_.newton_solves;
  const double longest_turn =
      phase_ == Phase::landing ? std::min(ds_, kJumpHalfSine) : options_.longest_half_sine;
  if (!(reading.largest_half_sine <= longest_turn)) return not_there(reading);
  if (tangents_ == 0 &&
      corrected_rad_ > options_.longest_start_share * target().pilot_deg * kRadPerDeg) {
    return not_there(reading);
  }
  if (tangents_ > 0 && (corrected_rad_ > options_.longest_correction_rad ||
                        !(std::abs(reading.tangent_cosine) >= options_.least_tangent_cosine))) {
    return not_there(reading);
  }
  if (forward_sign_ == 0) forward_sign_ = reading.determinant_sign;
  if (reading.determinant_sign != forward_sign_) return not_there(reading);
  return arrive(reading, reading.tangent_pilot < 0 ? -1 : 1);
}

Move Course::arrive(const Reading& reading, double tangent_sign) {
  const double step_rad =
      tangents_ > 0 ? (target().pilot_deg - result_.fold_limit_deg) * kRadPerDeg : 0;
  if (phase_ == Phase::landing) tangents_ = 0;
  phase_ = Phase::stepping;
  result_.fold_limit_deg = target().pilot_deg;
  tangent_pilot_[2] = std::exchange(tangent_pilot_[1], tangent_pilot_[0]);
  tangent_pilot_[0] = std::abs(reading.tangent_pilot);
  step_rad_[1] = std::exchange(step_rad_[0], step_rad);
  tangents_ = std::min(tangents_ + 1, 3);
  Move move;
  move.believe = move.arrived = true;
  move.tangent_sign = tangent_sign;
  return move;
}

// Extrapolates with the rates of change at the last stops, dx/dpilot = tangent / its pilot entry,
// integrated as a polynomial through up to three of them (Adams-Bashforth, unequal steps).
Move Course::proceed() {
  if (++stop_ == plan_->stops.size()) return end(PathEnd::end_reached);
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
  Move move;
  move.depart = move.hold = true;
  for (int k = 0; k < 3; ++k) move.along[k] = weight[k] / tangent_pilot_[k];
  move.pilot = target().pilot;
  return move;
}

Move Course::not_there(const Reading& reading) {
  if (phase_ == Phase::stepping) return begin_walk(reading);
  ds_ *= 0.5;
  phase_ = Phase::walking;
  return walk_on(reading.last_pilot);
}

Move Course::begin_walk(const Reading& reading) {
  if (tangents_ == 0) return end(PathEnd::start_lost);
  phase_ = Phase::walking;
  walk_steps_ = 0;
  bend_ = 0;
  const double gap = 2 * half_sine_between(target().pilot, reading.last_pilot);
  ds_ = std::min(options_.walk.longest_step_rad, 0.5 * gap / tangent_pilot_[0]);
  return walk_on(reading.last_pilot);
}

// The next step of the walk from the last point believed; see ArcLength::walk for the rules.
Move Course::walk_on(const HalfAngle<double>& last_pilot) {
  ++walk_steps_;
  ++result_.arc_steps;
  const double rise = ds_ * tangent_pilot_[0];
  if (bend_ > 0 && rise < options_.walk.turn_tolerance_rad) {
    result_.fold_limit_deg = angle_deg(last_pilot) + 0.5 * rise / kRadPerDeg;
    return end(PathEnd::fold_limit);
  }
  if (ds_ < options_.walk.shortest_step_rad || walk_steps_ > options_.walk.max_steps) {
    return end(PathEnd::stalled);
  }
  corrections_ = 0;
  corrected_rad_ = 0;
  Move move;
  move.depart = true;
  move.along[0] = ds_;
  return move;
}

// A point of the curve was found with the pilot free.
Move Course::walked(const Reading& reading) {
  const double sign = reading.tangent_cosine < 0 ? -1 : 1;
  const bool same_curve = reading.orientation * sign == forward_sign_ &&
                          sign * reading.tangent_cosine >= options_.walk.least_tangent_cosine;
  if (!same_curve) return not_there(reading);
  if (half_sine_between(reading.pilot, target().pilot) >= 0) {
    phase_ = Phase::landing;
    corrections_ = 0;
    corrected_rad_ = 0;
    Move move;
    move.depart = move.hold = true;
    move.along[0] = ds_ * half_sine_between(target().pilot, reading.last_pilot) /
                    half_sine_between(reading.pilot, reading.last_pilot);
    move.pilot = target().pilot;
    return move;
  }
  const double tangent_pilot = sign * reading.tangent_pilot;
  if (tangent_pilot <= 0) {
    const double before = tangent_pilot_[0];
    const double rise = ds_ * std::max(before, -tangent_pilot);
    const double way_left = 2 * half_sine_between(plan_->stops.back().pilot, reading.last_pilot);
    if (rise <
        std::max(options_.walk.turn_tolerance_rad, (1 - options_.turn_certain_share) * way_left)) {
      result_.fold_limit_deg = angle_deg(reading.last_pilot) + 0.5 * rise / kRadPerDeg;
      return end(PathEnd::fold_limit);
    }
    bend_ = (before - tangent_pilot) / ds_;
    ds_ = std::clamp(before / bend_, 0.1 * ds_, 0.9 * ds_);
    return walk_on(reading.last_pilot);
  }
  tangent_pilot_[0] = tangent_pilot;
  ds_ = bend_ > 0 ? tangent_pilot / bend_ : std::min(1.5 * ds_, options_.walk.longest_step_rad);
  Move move = walk_on(reading.pilot);
  move.believe = true;
  move.tangent_sign = sign;
  return move;
}

Move Course::end(PathEnd end) {
  result_.end = end;
  phase_ = Phase::idle;
  Move move;
  move.ended = true;
  return move;
}

}  // namespace misalign::solver
