// The arithmetic of Tracker: every lane at once.
#pragma once

#include <algorithm>

#include "solver/continuation/path_follower.hpp"

namespace misalign::solver {
template <class T>
Tracker<T>::Tracker(const Mechanism& mechanism, const Elimination& elimination,
                    const CourseOptions& options)
    : mechanism_(mechanism),
      unknowns_(mechanism.unknowns),
      lu_(elimination),
      geometry_(lane_geometry<T>(mechanism)),
      trial_(flat_state<T>(mechanism)),
      last_(trial_),
      ahead_(trial_),
      residual_(mechanism.equations, T(0)),
      y_(mechanism.unknowns, T(0)),
      correction_(mechanism.unknowns, T(0)),
      null_(correction_),
      move_(correction_),
      lengths_(mechanism.diagonals.size(), T(0)),
      slopes_(lengths_),
      tangents_{correction_, correction_, correction_} {
  courses_.fill(Course(options));
}

template <class T>
void Tracker<T>::put(const Departure& departure, int i) {
  put_lane(*departure.geometry, geometry_, i);
  put_lane(*departure.start, trial_, i);
  const HalfAngle<double>& pilot = departure.plan->stops[departure.first_stop].pilot;
  lane(trial_.creases[mechanism_.pilot].c, i) = pilot.c;
  lane(trial_.creases[mechanism_.pilot].s, i) = pilot.s;
  put_lane(*departure.start, last_, i);
}

// One Newton iteration of every lane, and what its course wants to know.
template <class T>
void Tracker<T>::iterate() {
  open_ = evaluate(mechanism_, geometry_, trial_, residual_.data(), lu_.entries());
  lu_.factorize();
  lu_.forward(residual_.data(), y_.data());
  solve();
  largest_correction_ = T(0);
  for (T& turn : correction_) {
    turn = -turn;
    largest_correction_ = larger(largest_correction_, magnitude(turn));
  }
  advance(mechanism_, correction_.data(), trial_);
  largest_half_sine_ = T(0);
  for (std::size_t k = 0; k < trial_.creases.size(); ++k) {
    largest_half_sine_ = larger(largest_half_sine_,
                                magnitude(half_sine_between(trial_.creases[k], last_.creases[k])));
  }
}

// The unit tangent, and the correction: with the pilot held, or for lanes on a walk the shortest.
template <class T>
void Tracker<T>::solve() {
  using std::sqrt;
  const int n = mechanism_.equations;
  const T& s_q = lu_.partner_coefficient();
  const T& s_p = lu_.pilot_coefficient();
  T walking(0);
  for (int i = 0; i < kWidth; ++i) lane(walking, i) = courses_[i].walking() ? 1 : 0;
  const auto hold_pilot = magnitude(s_q) >= select(walking > T(0), magnitude(s_p), T(0));
  const T rest = y_[n - 1];
  lu_.backward(y_.data(), select(hold_pilot, rest / s_q, T(0)),
               select(hold_pilot, T(0), rest / s_p), correction_.data());
  lu_.null_vector(-s_p, s_q, y_.data(), null_.data());
  T square(0), along(0);
  cosine_ = T(0);
  for (int j = 0; j < unknowns_; ++j) {
    square = square + null_[j] * null_[j];
    along = along + null_[j] * correction_[j];
    cosine_ = cosine_ + null_[j] * tangents_[0][j];
  }
  const T scale = T(1) / sqrt(square);
  cosine_ = cosine_ * scale;
  along = select(walking > T(0), along / square, T(0));
  for (int j = 0; j < unknowns_; ++j) {
    correction_[j] = correction_[j] - along * null_[j];
    null_[j] = null_[j] * scale;
  }
  // det J = sign of the permutation times the pivots; the last of them is s_q, the tangent's pilot
  // entry before scaling, and det [J; t] = det J / t_pilot.
  orientation_ = lu_.orientation();
  determinant_sign_ = select(s_q < T(0), -orientation_, orientation_);
}

template <class T>
Reading Tracker<T>::reading(int i) const {
  const auto pilot_of = [&](const FoldState<T>& state) {
    const HalfAngle<T>& pilot = state.creases[mechanism_.pilot];
    return HalfAngle<double>{lane(pilot.c, i), lane(pilot.s, i)};
  };
  return {lane(open_, i),
          lane(largest_correction_, i),
          lane(determinant_sign_, i) < 0 ? -1 : 1,
          lane(orientation_, i) < 0 ? -1 : 1,
          lane(null_[unknowns_ - 1], i),
          lane(cosine_, i),
          lane(largest_half_sine_, i),
          pilot_of(last_),
          pilot_of(trial_)};
}

// Keeps the states, tangents and diagonals of the lanes that found a point of their curve.
template <class T>
void Tracker<T>::believe() {
  T believed(0), sign(1);
  bool any = false, arrived = false;
  for (int i = 0; i < kWidth; ++i) {
    lane(believed, i) = moves_[i].believe ? 1 : 0;
    lane(sign, i) = moves_[i].tangent_sign;
    any = any || moves_[i].believe;
    arrived = arrived || moves_[i].arrived;
  }
  if (!any) return;
  replace(believed, trial_, last_);
  const auto chosen = believed > T(0);
  for (int j = 0; j < unknowns_; ++j) {
    tangents_[2][j] = select(chosen, tangents_[1][j], tangents_[2][j]);
    tangents_[1][j] = select(chosen, tangents_[0][j], tangents_[1][j]);
    tangents_[0][j] = select(chosen, sign * null_[j], tangents_[0][j]);
  }
  slopes_known_ = false;
  if (arrived) folded_lengths(mechanism_, geometry_, last_, lengths_.data());
}

// Sets the lanes that depart on their way: `last` moved along the tangents. A turn by d is entered
// as 2 tan(d / 2), to third order, because `advance` turns by 2 atan of half its entry.
template <class T>
void Tracker<T>::depart() {
  T departs(0), along[3] = {T(0), T(0), T(0)};
  bool any = false;
  for (int i = 0; i < kWidth; ++i) {
    lane(departs, i) = moves_[i].depart ? 1 : 0;
    for (int k = 0; k < 3; ++k) lane(along[k], i) = moves_[i].along[k];
    any = any || moves_[i].depart;
  }
  if (!any) return;
  for (int j = 0; j < unknowns_; ++j) {
    const T turn =
        along[0] * tangents_[0][j] + along[1] * tangents_[1][j] + along[2] * tangents_[2][j];
    move_[j] = turn + turn * turn * turn * T(1.0 / 12);
  }
  ahead_ = last_;
  advance(mechanism_, move_.data(), ahead_);
  replace(departs, ahead_, trial_);
  for (int i = 0; i < kWidth; ++i) {
    if (!moves_[i].hold) continue;
    lane(trial_.creases[mechanism_.pilot].c, i) = moves_[i].pilot.c;
    lane(trial_.creases[mechanism_.pilot].s, i) = moves_[i].pilot.s;
  }
}

template <class T>
void Tracker<T>::copy_lengths(int i, double* lengths) const {
  for (const T& length : lengths_) *lengths++ = lane(length, i);
}

template <class T>
void Tracker<T>::find_slopes() {
  folded_lengths_and_slopes(mechanism_, geometry_, last_, tangents_[0].data(), lengths_.data(),
                            slopes_.data(), residual_.data());
  misfit_ = T(0);
  for (const T& rest : residual_) misfit_ = larger(misfit_, magnitude(rest));
  slopes_known_ = true;
}

// For all lanes at once, on first demand.
template <class T>
double Tracker<T>::copy_slopes(int i, double* slopes) {
  if (!slopes_known_) find_slopes();
  const double rate = pilot_rate(i);
  for (const T& slope : slopes_) *slopes++ = lane(slope, i) / rate;
  return lane(misfit_, i) / rate;
}

}  // namespace misalign::solver
