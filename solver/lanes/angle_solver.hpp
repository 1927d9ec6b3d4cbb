// As many sheets as there are lanes, all at one angle, straight from the base folding or from
// states that are known. From the base one step with its factors, then two corrections: the second
// one's size against the first one's tells how far away the solution still is. Where slopes are
// wanted both are Newton's, with factors of their own; otherwise the second uses the first one's.
// The tangent is not corrected: how far it is from keeping the loops closed, weighted by how that
// shows in each diagonal of the base folding, corrects the slopes instead (the adjoint correction
// of Giles & Pierce, Acta Numerica 11, 2002) and says how well they are known, whether Newton or
// single precision left it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/lane_state.hpp"
#include "solver/linear/held_correction.hpp"
#include "solver/model/rejection_test.hpp"

namespace misalign::solver {

template <class T>
class AngleSolver {
 public:
  using Real = Scalar<T>;

  /// `model` and `angles` must outlive this object.
  AngleSolver(const Model& model, const std::vector<TestAngle>& angles);

  /// Puts so many sheets of a block into lanes, by their numbers; empty lanes repeat the first.
  void load(const ShiftBlock& block, const std::array<int, kLanes<T>>& numbers, int count);
  /// The same of sheets first, first + 1, ...
  void load(const ShiftBlock& block, int first, int count);
  /// Their states, lengths and, where the angle has them, slopes; from the base folding.
  MISALIGN_FLATTEN void solve(int angle);
  /// The same from this state, rounded as it may be.
  MISALIGN_FLATTEN void solve_from(const FoldState<T>& state, int angle);
  /// The same from a state at another angle, turned by this much of the pilot (rad) along its
  /// rates.
  MISALIGN_FLATTEN void solve_ahead(const FoldState<T>& state, const std::vector<T>& rates,
                                    double by_rad, int angle);

  const SheetGeometry<T>& geometry() const { return geometry_; }
  const FoldState<T>& state() const { return state_; }
  /// Factors of the last Jacobian, one correction before the state.
  const SparseLu<T>& factors() const { return lu_; }
  const std::vector<T>& lengths() const { return lengths_; }
  const std::vector<T>& slopes() const { return slopes_; }
  /// Of all unknowns with the pilot, where slopes are wanted.
  const std::vector<T>& rates() const { return turn_; }
  /// Largest change that the tangent's misfit made to a slope.
  const T& slope_correction() const { return slope_correction_; }
  /// How far lengths in lane i may be off (panel widths); none where the state is not to be
  /// trusted: Newton did not converge, or it lies on another branch than the base folding.
  std::optional<double> length_error(int angle, int i) const;
  /// The same of a state that was solved ahead, which must be on the same curve as before.
  std::optional<double> length_error_ahead(int angle, int i) const;

 private:
  T correct(bool new_factors);
  void finish(int angle);
  T correct_slopes(int angle);

  const Model& model_;
  const Mechanism& mechanism_;
  const std::vector<TestAngle>& angles_;
  // Per angle, in this precision: the base folding in every lane, and what it shares.
  std::vector<FoldState<T>> base_;
  std::vector<SparseLu<Real>> base_factors_;
  std::vector<std::vector<Real>> lengths_per_closure_;
  std::vector<T> base_x_, base_y_;  // panel widths
  SheetGeometry<T> geometry_;
  FoldState<T> state_;
  std::vector<T> residual_, y_, turn_, lengths_, slopes_;
  SparseLu<T> lu_;
  T first_correction_, second_correction_, determinant_sign_, slope_correction_ = T(0);
  T predictor_correction_ = T(0), largest_half_sine_ = T(0);
};

template <class T>
AngleSolver<T>::AngleSolver(const Model& model, const std::vector<TestAngle>& angles)
    : model_(model),
      mechanism_(model.mechanism()),
      angles_(angles),
      geometry_(lane_geometry<T>(mechanism_)),
      state_(flat_state<T>(mechanism_)),
      residual_(mechanism_.equations, T(0)),
      y_(mechanism_.unknowns, T(0)),
      turn_(mechanism_.unknowns, T(0)),
      lengths_(mechanism_.diagonals.size(), T(0)),
      slopes_(lengths_),
      lu_(model.elimination()) {
  for (const TestAngle& angle : angles) {
    FoldState<T>& base = base_.emplace_back(state_);
    for (int i = 0; i < kLanes<T>; ++i) put_lane(angle.base, base, i);
    base_factors_.emplace_back(angle.factors);
    lengths_per_closure_.emplace_back(angle.lengths_per_closure.begin(),
                                      angle.lengths_per_closure.end());
  }
  const double* const flat_mm = model.base().sheet.vertices_mm.data();
  for (int v = 0; v < mechanism_.vertices; ++v) {
    const double x_mm = flat_mm[2 * v] - flat_mm[0], y_mm = flat_mm[2 * v + 1] - flat_mm[1];
    base_x_.push_back(T(static_cast<Real>(x_mm / mechanism_.panel_width_mm)));
    base_y_.push_back(T(static_cast<Real>(y_mm / mechanism_.panel_width_mm)));
  }
  geometry_.x = base_x_;
  geometry_.y = base_y_;
}

template <class T>
void AngleSolver<T>::load(const ShiftBlock& block, int first, int count) {
  std::array<int, kLanes<T>> numbers;
  for (int i = 0; i < kLanes<T>; ++i) numbers[i] = first + i;
  load(block, numbers, count);
}

template <class T>
void AngleSolver<T>::load(const ShiftBlock& block, const std::array<int, kLanes<T>>& numbers,
                          int count) {
  using std::sqrt;
  const T per_width(static_cast<Real>(1 / mechanism_.panel_width_mm));
  std::array<const double*, kLanes<T>> shifts;
  for (int i = 0; i < kLanes<T>; ++i) shifts[i] = block.of(numbers[i < count ? i : 0]);
  int k = 0;
  for (const int vertex : model_.shifted()) {
    T dx, dy;
    for (int i = 0; i < kLanes<T>; ++i) {
      lane(dx, i) = static_cast<Real>(shifts[i][k]);
      lane(dy, i) = static_cast<Real>(shifts[i][k + 1]);
    }
    geometry_.x[vertex] = base_x_[vertex] + dx * per_width;
    geometry_.y[vertex] = base_y_[vertex] + dy * per_width;
    k += 2;
  }
  for (const Crease& crease : mechanism_.creases) {
    const T dx = geometry_.x[crease.b] - geometry_.x[crease.a];
    const T dy = geometry_.y[crease.b] - geometry_.y[crease.a];
    const T inverse = T(1) / sqrt(dx * dx + dy * dy);
    geometry_.axis_x[crease.edge] = dx * inverse;
    geometry_.axis_y[crease.edge] = dy * inverse;
  }
}

template <class T>
void AngleSolver<T>::solve(int angle) {
  const SparseLu<Real>& factors = base_factors_[angle];
  state_ = base_[angle];
  evaluate(mechanism_, geometry_, state_, residual_.data(), nullptr);
  factors.forward(residual_.data(), y_.data());
  factors.backward_held(y_.data(), turn_.data());
  for (T& turn : turn_) turn = -turn;
  advance(mechanism_, turn_.data(), state_);
  finish(angle);
}

template <class T>
void AngleSolver<T>::solve_from(const FoldState<T>& state, int angle) {
  state_ = state;
  for (T& turn : turn_) turn = T(0);
  advance(mechanism_, turn_.data(), state_);
  state_.creases[mechanism_.pilot] = base_[angle].creases[mechanism_.pilot];
  finish(angle);
}

template <class T>
void AngleSolver<T>::solve_ahead(const FoldState<T>& state, const std::vector<T>& rates,
                                 double by_rad, int angle) {
  state_ = state;
  // As 2 tan(turn / 2), to third order, because `advance` turns by 2 atan of half its entry.
  for (std::size_t j = 0; j < turn_.size(); ++j) {
    const T turn = T(static_cast<Real>(by_rad)) * rates[j];
    turn_[j] = turn + turn * turn * turn * T(static_cast<Real>(1.0 / 12));
  }
  advance(mechanism_, turn_.data(), state_);
  state_.creases[mechanism_.pilot] = base_[angle].creases[mechanism_.pilot];
  predictor_correction_ = correct(true);
  finish(angle);
  largest_half_sine_ = T(0);
  for (std::size_t k = 0; k < state.creases.size(); ++k) {
    largest_half_sine_ = larger(largest_half_sine_,
                                magnitude(half_sine_between(state_.creases[k], state.creases[k])));
  }
}

template <class T>
void AngleSolver<T>::finish(int angle) {
  const bool with_slopes = angles_[angle].with_slopes;
  first_correction_ = correct(true);
  second_correction_ = correct(with_slopes);
  determinant_sign_ = lu_.determinant_sign();
  if (with_slopes) {
    lu_.null_vector(-lu_.pilot_coefficient() / lu_.partner_coefficient(), T(1), y_.data(),
                    turn_.data());
    folded_lengths_and_slopes(mechanism_, geometry_, state_, turn_.data(), lengths_.data(),
                              slopes_.data(), residual_.data());
    slope_correction_ = correct_slopes(angle);
  } else {
    folded_lengths(mechanism_, geometry_, state_, lengths_.data());
  }
}

// One correction with the pilot held, by new factors or those that are there; returns the largest
// turn it made.
template <class T>
T AngleSolver<T>::correct(bool new_factors) {
  correct_held(mechanism_, geometry_, new_factors, lu_, residual_, y_, turn_, state_);
  T largest(0);
  for (const T& turn : turn_) largest = larger(largest, magnitude(turn));
  return largest;
}

template <class T>
std::optional<double> AngleSolver<T>::length_error(int angle, int i) const {
  const TestAngle& at = angles_[angle];
  if ((lane(determinant_sign_, i) < 0) != (at.determinant_sign < 0)) return std::nullopt;
  const double first = lane(first_correction_, i), second = lane(second_correction_, i);
  return at.with_slopes ? newton_error(first, second, model_.length_per_rad())
                        : chord_error(first, second, model_.length_per_rad());
}

template <class T>
std::optional<double> AngleSolver<T>::length_error_ahead(int angle, int i) const {
  const double corrected_rad =
      lane(predictor_correction_, i) + lane(first_correction_, i) + lane(second_correction_, i);
  if (!(corrected_rad <= kRejection.longest_correction_rad) ||
      !(lane(largest_half_sine_, i) <= kRejection.longest_half_sine)) {
    return std::nullopt;
  }
  return length_error(angle, i);
}

// Takes off what the tangent's misfit adds to the slopes, weighted as on the base folding; returns
// the largest change.
template <class T>
T AngleSolver<T>::correct_slopes(int angle) {
  T largest(0);
  const Real* weight = lengths_per_closure_[angle].data();
  for (T& slope : slopes_) {
    T sum(0);
    for (const T& misfit : residual_) sum = sum + T(*weight++) * misfit;
    slope = slope - sum;
    largest = larger(largest, magnitude(sum));
  }
  return largest;
}

}  // namespace misalign::solver
