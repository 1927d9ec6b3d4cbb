// Solves one sheet per lane, all at one level, straight from the base folding or from known states.
// The start from the base is one step with its factors, then two corrections of Newton's method:
// the ratio of their sizes tells how far away the solution still is. The tangent is that of the
// last Jacobian, one correction before the state: how far it is from keeping the loops closed,
// weighted by how that shows in each diagonal of the base folding, corrects the slopes (the adjoint
// correction of Giles & Pierce, Acta Numerica 11, 2002) and says how well they are known, whether
// Newton or single precision left it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/continuation/step.hpp"
#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/lane_state.hpp"
#include "solver/linear/level_correction.hpp"
#include "solver/model/rejection_test.hpp"

namespace misalign::solver {

template <class T>
class LevelSolver {
 public:
  using Real = Scalar<T>;

  /// `model` and `places` must outlive this object.
  LevelSolver(const Model& model, const std::vector<TestPlace>& places);

  /// Puts `count` sheets of a block into lanes, by their numbers; empty lanes repeat the first.
  void load(const ShiftBlock& block, const std::array<int, kLanes<T>>& numbers, int count);
  /// The same for sheets first, first + 1, ...
  void load(const ShiftBlock& block, int first, int count);
  /// Finds states, lengths and slopes at the level of a place, from the base folding.
  MISALIGN_FLATTEN void solve(int place);
  /// The same while the shifts grow from zero in `steps` steps, with one correction each.
  void solve_growing(int place, int steps);
  /// The same from nearby states, which may be rounded: at the levels of those states.
  MISALIGN_FLATTEN void solve_from(const FoldState<T>& state, int place);
  /// The same from other states, moved by `by_rad` (one per lane) along their unit tangents and
  /// corrected across these; lanes where `pilot` is not flat hold it instead.
  MISALIGN_FLATTEN void solve_ahead(const FoldState<T>& state, const std::vector<T>& tangent,
                                    const T& by_rad, const HalfAngle<T>& pilot, int place);

  const SheetGeometry<T>& geometry() const { return geometry_; }
  const FoldState<T>& state() const { return state_; }
  /// Factors of the last Jacobian, one correction before the state.
  const SparseLu<T>& factors() const { return closure_.factors(); }
  const std::vector<T>& lengths() const { return lengths_; }
  /// Rates of the lengths by the level (per rad), or by the arc length after solve_ahead().
  const std::vector<T>& slopes() const { return slopes_; }
  /// Rates of all unknowns, likewise.
  const std::vector<T>& tangent() const { return tangent_; }
  /// Largest change that the tangent's misfit made to a slope.
  const T& slope_correction() const { return slope_correction_; }
  /// Returns the error bound of the lengths in lane i (panel widths); none where the state cannot
  /// be trusted: Newton did not converge, went too far from the base folding (kLongestStartShare)
  /// or in a step of the shifts, or found another branch.
  std::optional<double> length_error(int place, int i) const;
  /// The same after solve_ahead(): the state must be on the same curve as before.
  std::optional<double> length_error_ahead(int i) const;

 private:
  T correct(const std::vector<T>& level);
  T largest_turn() const;
  void finish(const std::vector<T>& level, int place);
  T correct_slopes(int place);

  const Model& model_;
  const Mechanism& mechanism_;
  const std::vector<TestPlace>& places_;
  std::vector<FoldState<T>> base_;
  std::vector<SparseLu<Real>> base_factors_;
  std::vector<std::vector<Real>> lengths_per_closure_;
  std::vector<std::vector<T>> levels_, base_tangents_;
  const SheetGeometry<T> base_sheet_;
  SheetGeometry<T> geometry_, whole_;
  FoldState<T> state_;
  std::vector<T> residual_, y_, row_, turn_, tangent_, lengths_, slopes_;
  SparseClosure<T> closure_;
  T first_correction_, second_correction_, orientation_, slope_correction_ = T(0);
  T from_base_ = T(0), largest_growth_ = T(0), predictor_correction_ = T(0);
  T largest_half_sine_ = T(0), goes_forward_ = T(0);
};

template <class T>
LevelSolver<T>::LevelSolver(const Model& model, const std::vector<TestPlace>& places)
    : model_(model),
      mechanism_(model.mechanism()),
      places_(places),
      base_sheet_(in_all_lanes<T>(mechanism_, model.base().sheet.vertices_mm)),
      geometry_(base_sheet_),
      whole_(base_sheet_),
      state_(flat_state<T>(mechanism_)),
      residual_(mechanism_.equations, T(0)),
      y_(mechanism_.unknowns, T(0)),
      row_(y_),
      turn_(y_),
      tangent_(y_),
      lengths_(mechanism_.diagonals.size(), T(0)),
      slopes_(lengths_),
      closure_(mechanism_, model.elimination()) {
  const auto in_lanes = [](const std::vector<double>& values) {
    std::vector<T> lanes;
    for (const double value : values) lanes.push_back(T(static_cast<Real>(value)));
    return lanes;
  };
  for (const TestPlace& at : places) {
    FoldState<T>& base = base_.emplace_back(state_);
    for (int i = 0; i < kLanes<T>; ++i) put_lane(at.base, base, i);
    base_factors_.emplace_back(at.factors);
    lengths_per_closure_.emplace_back(at.lengths_per_closure.begin(), at.lengths_per_closure.end());
    levels_.push_back(in_lanes(at.level));
    base_tangents_.push_back(in_lanes(at.tangent));
  }
}

template <class T>
void LevelSolver<T>::load(const ShiftBlock& block, int first, int count) {
  std::array<int, kLanes<T>> numbers;
  for (int i = 0; i < kLanes<T>; ++i) numbers[i] = first + i;
  load(block, numbers, count);
}

template <class T>
void LevelSolver<T>::load(const ShiftBlock& block, const std::array<int, kLanes<T>>& numbers,
                          int count) {
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
    geometry_.x[vertex] = base_sheet_.x[vertex] + dx * per_width;
    geometry_.y[vertex] = base_sheet_.y[vertex] + dy * per_width;
    k += 2;
  }
  turn_axes(mechanism_, geometry_);
}

template <class T>
void LevelSolver<T>::solve(int place) {
  const SparseLu<Real>& factors = base_factors_[place];
  const std::vector<T>&level = levels_[place], &tangent = base_tangents_[place];
  state_ = base_[place];
  evaluate(mechanism_, geometry_, state_, residual_.data(), nullptr);
  factors.forward(residual_.data(), y_.data());
  factors.backward_held(y_.data(), turn_.data());
  T change(0);
  for (std::size_t j = 0; j < turn_.size(); ++j) change = change + level[j] * turn_[j];
  for (std::size_t j = 0; j < turn_.size(); ++j) turn_[j] = change * tangent[j] - turn_[j];
  from_base_ = largest_turn();
  largest_growth_ = T(0);
  advance(mechanism_, turn_.data(), state_);
  finish(level, place);
}

template <class T>
void LevelSolver<T>::solve_growing(int place, int steps) {
  whole_ = geometry_;
  const auto grow_to = [&](int step) {
    const T share(static_cast<Real>(1.0 * step / steps));
    put_between(mechanism_, base_sheet_, whole_, share, geometry_);
  };
  grow_to(1);
  solve(place);
  largest_growth_ = from_base_;
  from_base_ = T(0);
  for (int step = 2; step <= steps; ++step) {
    grow_to(step);
    largest_growth_ = larger(largest_growth_, correct(levels_[place]));
  }
  finish(levels_[place], place);
}

template <class T>
void LevelSolver<T>::solve_from(const FoldState<T>& state, int place) {
  from_base_ = largest_growth_ = T(0);
  state_ = state;
  for (T& turn : turn_) turn = T(0);
  advance(mechanism_, turn_.data(), state_);
  finish(levels_[place], place);
}

template <class T>
void LevelSolver<T>::solve_ahead(const FoldState<T>& state, const std::vector<T>& tangent,
                                 const T& by_rad, const HalfAngle<T>& pilot, int place) {
  state_ = state;
  const auto is_held = pilot.s > T(0);
  for (std::size_t j = 0; j < row_.size(); ++j) row_[j] = select(is_held, T(0), tangent[j]);
  row_.back() = select(is_held, T(1), tangent.back());
  // Entries are 2 tan(turn / 2), to third order, because `advance` turns by 2 atan of half its
  // entry.
  for (std::size_t j = 0; j < turn_.size(); ++j) {
    const T turn = by_rad * tangent[j];
    turn_[j] = turn + turn * turn * turn * T(static_cast<Real>(1.0 / 12));
  }
  advance(mechanism_, turn_.data(), state_);
  HalfAngle<T>& pilot_angle = state_.creases[mechanism_.pilot];
  pilot_angle = {select(is_held, pilot.c, pilot_angle.c), select(is_held, pilot.s, pilot_angle.s)};
  predictor_correction_ = correct(row_);
  finish(row_, place);
  goes_forward_ = T(0);
  for (std::size_t j = 0; j < tangent.size(); ++j) {
    goes_forward_ = goes_forward_ + tangent[j] * tangent_[j];
  }
  largest_half_sine_ = T(0);
  for (std::size_t k = 0; k < state.creases.size(); ++k) {
    largest_half_sine_ = larger(largest_half_sine_,
                                magnitude(half_sine_between(state_.creases[k], state.creases[k])));
  }
}

template <class T>
void LevelSolver<T>::finish(const std::vector<T>& level, int place) {
  first_correction_ = correct(level);
  second_correction_ = correct(level);
  folded_lengths_and_slopes(mechanism_, geometry_, state_, tangent_.data(), lengths_.data(),
                            slopes_.data(), residual_.data());
  slope_correction_ = correct_slopes(place);
}

// Corrects once; returns the largest turn.
template <class T>
T LevelSolver<T>::correct(const std::vector<T>& level) {
  orientation_ = correct_on_level(mechanism_, geometry_, level, closure_, turn_, tangent_, state_);
  return largest_turn();
}

template <class T>
T LevelSolver<T>::largest_turn() const {
  T largest(0);
  for (const T& turn : turn_) largest = larger(largest, magnitude(turn));
  return largest;
}

template <class T>
std::optional<double> LevelSolver<T>::length_error(int place, int i) const {
  const double turned_rad =
      lane(from_base_, i) + lane(first_correction_, i) + lane(second_correction_, i);
  const double pilot_rad = places_[place].pilot_deg * kRadPerDeg;
  if (!(turned_rad <= kLongestStartShare * pilot_rad) ||
      !(lane(largest_growth_, i) <= kRejection.longest_growth_share * pilot_rad)) {
    return std::nullopt;
  }
  if ((lane(orientation_, i) < 0) != (places_[place].orientation < 0)) return std::nullopt;
  return newton_error(lane(first_correction_, i), lane(second_correction_, i),
                      model_.length_per_rad());
}

template <class T>
std::optional<double> LevelSolver<T>::length_error_ahead(int i) const {
  const double corrected_rad =
      lane(predictor_correction_, i) + lane(first_correction_, i) + lane(second_correction_, i);
  if (!(corrected_rad <= kRejection.longest_correction_rad) ||
      !(lane(largest_half_sine_, i) <= kRejection.longest_half_sine) ||
      !(lane(goes_forward_, i) > 0)) {
    return std::nullopt;
  }
  return newton_error(lane(first_correction_, i), lane(second_correction_, i),
                      model_.length_per_rad());
}

// Takes off what the tangent's misfit adds to the slopes, weighted as on the base folding; returns
// the largest change.
template <class T>
T LevelSolver<T>::correct_slopes(int place) {
  T largest(0);
  const Real* weight = lengths_per_closure_[place].data();
  for (T& slope : slopes_) {
    T sum(0);
    for (const T& misfit : residual_) sum = sum + T(*weight++) * misfit;
    slope = slope - sum;
    largest = larger(largest, magnitude(sum));
  }
  return largest;
}

}  // namespace misalign::solver
