// The arithmetic of Tracker: every lane at once.
#pragma once

#include <algorithm>

#include "solver/tracker.hpp"

namespace misalign::solver {
namespace detail {

template <class T>
SheetGeometry<T> lanes_of(const Mechanism& mechanism, std::size_t vertices) {
  SheetGeometry<T> geometry;
  geometry.x.assign(vertices, T(0));
  geometry.y.assign(vertices, T(0));
  geometry.axis_x.assign(mechanism.edges.size(), T(1));
  geometry.axis_y.assign(mechanism.edges.size(), T(0));
  return geometry;
}

// `b` in the lanes where `choice` is positive, else `a`.
template <class T>
void replace(const T& choice, const FoldState<T>& b, FoldState<T>& a) {
  const auto chosen = choice > T(0);
  for (std::size_t k = 0; k < a.creases.size(); ++k) {
    a.creases[k] = {select(chosen, b.creases[k].c, a.creases[k].c),
                    select(chosen, b.creases[k].s, a.creases[k].s)};
  }
  for (std::size_t k = 0; k < a.balls.size(); ++k) {
    const Quaternion<T>&p = a.balls[k], &q = b.balls[k];
    a.balls[k] = {select(chosen, q.w, p.w), select(chosen, q.x, p.x), select(chosen, q.y, p.y),
                  select(chosen, q.z, p.z)};
  }
}

}  // namespace detail

template <class T>
void put_lane(const SheetGeometry<double>& from, SheetGeometry<T>& to, int i) {
  for (std::size_t v = 0; v < from.x.size(); ++v) {
    lane(to.x[v], i) = from.x[v];
    lane(to.y[v], i) = from.y[v];
  }
  for (std::size_t e = 0; e < from.axis_x.size(); ++e) {
    lane(to.axis_x[e], i) = from.axis_x[e];
    lane(to.axis_y[e], i) = from.axis_y[e];
  }
}

template <class T>
void put_lane(const FoldState<double>& from, FoldState<T>& to, int i) {
  for (std::size_t k = 0; k < from.creases.size(); ++k) {
    lane(to.creases[k].c, i) = from.creases[k].c;
    lane(to.creases[k].s, i) = from.creases[k].s;
  }
  for (std::size_t k = 0; k < from.balls.size(); ++k) {
    lane(to.balls[k].w, i) = from.balls[k].w;
    lane(to.balls[k].x, i) = from.balls[k].x;
    lane(to.balls[k].y, i) = from.balls[k].y;
    lane(to.balls[k].z, i) = from.balls[k].z;
  }
}

template <class T>
Tracker<T>::Tracker(const Mechanism& mechanism, const Elimination& elimination,
                    const CourseOptions& options)
    : mechanism_(mechanism),
      unknowns_(mechanism.unknowns),
      lu_(elimination),
      geometry_(detail::lanes_of<T>(mechanism, mechanism.vertices)),
      trial_(flat_state<T>(mechanism)),
      last_(trial_),
      ahead_(trial_),
      residual_(mechanism.equations, T(0)),
      values_(elimination.slot_of_value.size(), T(0)),
      y_(mechanism.equations, T(0)),
      correction_(mechanism.unknowns, T(0)),
      null_(correction_),
      move_(correction_),
      lengths_(mechanism.diagonals.size(), T(0)),
      ahead_lengths_(lengths_),
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
  open_ = evaluate(mechanism_, geometry_, trial_, residual_.data(), values_.data());
  lu_.factorize(values_.data());
  lu_.forward(residual_.data(), y_.data());
  solve();
  for (T& turn : correction_) turn = -turn;
  advance(mechanism_, correction_.data(), trial_);
  largest_half_sine_ = T(0);
  for (std::size_t k = 0; k < trial_.creases.size(); ++k) {
    largest_half_sine_ =
        larger(largest_half_sine_,
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
  lu_.backward(y_.data(), select(hold_pilot, rest / s_q, T(0)), select(hold_pilot, T(0), rest / s_p),
               correction_.data());
  lu_.null_vector(-s_p, s_q, null_.data());
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
  orientation_ = T(lu_.plan().permutation_sign);
  for (int k = 0; k + 1 < n; ++k) {
    orientation_ = select(lu_.pivot(k) < T(0), -orientation_, orientation_);
  }
  determinant_sign_ = select(s_q < T(0), -orientation_, orientation_);
}

template <class T>
Reading Tracker<T>::reading(int i) const {
  const auto pilot_of = [&](const FoldState<T>& state) {
    const HalfAngle<T>& pilot = state.creases[mechanism_.pilot];
    return HalfAngle<double>{lane(pilot.c, i), lane(pilot.s, i)};
  };
  return {lane(open_, i),
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
  detail::replace(believed, trial_, last_);
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
  detail::replace(departs, ahead_, trial_);
  for (int i = 0; i < kWidth; ++i) {
    if (!moves_[i].hold) continue;
    lane(trial_.creases[mechanism_.pilot].c, i) = moves_[i].pilot.c;
    lane(trial_.creases[mechanism_.pilot].s, i) = moves_[i].pilot.s;
  }
}

template <class T>
void Tracker<T>::copy_state(int i, FoldState<double>& state) const {
  for (std::size_t k = 0; k < state.creases.size(); ++k) {
    state.creases[k] = {lane(last_.creases[k].c, i), lane(last_.creases[k].s, i)};
  }
  for (std::size_t k = 0; k < state.balls.size(); ++k) {
    const Quaternion<T>& q = last_.balls[k];
    state.balls[k] = {lane(q.w, i), lane(q.x, i), lane(q.y, i), lane(q.z, i)};
  }
}

// One difference for all lanes along their tangents, on first demand.
template <class T>
double Tracker<T>::slope(int diagonal, int i) {
  constexpr double kStep_rad = 1e-5;  // error 1e-11 by rounding, 1e-5 of the curvature by order
  if (!slopes_known_) {
    for (int j = 0; j < unknowns_; ++j) move_[j] = T(kStep_rad) * tangents_[0][j];
    ahead_ = last_;
    advance(mechanism_, move_.data(), ahead_);
    folded_lengths(mechanism_, geometry_, ahead_, ahead_lengths_.data());
    slopes_known_ = true;
  }
  const double change = lane(ahead_lengths_[diagonal], i) - lane(lengths_[diagonal], i);
  return change / (kStep_rad * lane(tangents_[0][unknowns_ - 1], i));
}

}  // namespace misalign::solver
