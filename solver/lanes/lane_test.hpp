// A rejection test: as many sheets as there are lanes, all at one angle, straight from the base
// folding. One step with the base's factors, then two corrections: the second one's size against
// the first one's tells how far away the solution still is. Where slopes are wanted both are
// Newton's, with factors of their own; otherwise the second uses the first one's. The tangent is
// not corrected: how far it is from keeping the loops closed, weighted by how that shows in each
// diagonal of the base folding, corrects the slopes instead (the adjoint correction of Giles &
// Pierce, Acta Numerica 11, 2002) and says how well they are known, whether Newton or single
// precision left it.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/lane_math.hpp"
#include "solver/lanes/observers.hpp"

namespace misalign::solver {

template <class T>
class LaneTest {
 public:
  explicit LaneTest(const Model& model);

  /// Looks at every open sheet at the angle of the test with this index and tells `rules` what it
  /// sees (a RejectionTest). Of the sheets that are not decided then, `approach` keeps a state that
  /// can be trusted, the far one if there is a choice (an ApproachObserver).
  template <class Rules, class Approach>
  void run(int test, const ShiftBlock& block, std::vector<OpenSheet>& open, Rules& rules,
           Approach& approach) {
    for (std::size_t first = 0; first < open.size(); first += kLanes<T>) {
      const int count = static_cast<int>(std::min<std::size_t>(kLanes<T>, open.size() - first));
      load(block, open.data() + first, count);
      solve(test);
      report(test, open.data() + first, count, rules, approach);
    }
  }

  const Effort& effort() const { return effort_; }

 private:
  using Real = Scalar<T>;

  void load(const ShiftBlock& block, const OpenSheet* open, int count);
  MISALIGN_FLATTEN void solve(int test);
  MISALIGN_FLATTEN T correct(bool new_factors);
  T correct_slopes(int test);
  template <class Rules, class Approach>
  void report(int test, OpenSheet* open, int count, Rules& rules, Approach& approach);

  const Model& model_;
  const Mechanism& mechanism_;
  // Per test: what TestAngle has, in this precision, the base folding in every lane; and its
  // rounding.
  std::vector<FoldState<T>> base_;
  std::vector<SparseLu<Real>> base_factors_;
  std::vector<std::vector<Real>> lengths_per_closure_;
  std::vector<double> rounding_;
  std::vector<T> base_x_, base_y_;  // panel widths
  SheetGeometry<T> geometry_;
  FoldState<T> state_;
  std::vector<T> residual_, y_, turn_, flat_, lengths_, slopes_;
  SparseLu<T> lu_;
  T first_correction_, second_correction_, determinant_sign_, slope_correction_ = T(0);
  std::vector<double> lane_flat_, lane_lengths_, lane_slopes_;
  Effort effort_;
};

template <class T>
LaneTest<T>::LaneTest(const Model& model)
    : model_(model),
      mechanism_(model.mechanism()),
      state_(flat_state<T>(mechanism_)),
      residual_(mechanism_.equations, T(0)),
      y_(mechanism_.unknowns, T(0)),
      turn_(mechanism_.unknowns, T(0)),
      flat_(mechanism_.diagonals.size(), T(0)),
      lengths_(flat_),
      slopes_(flat_),
      lu_(model.elimination()) {
  lane_flat_.resize(flat_.size());
  lane_lengths_.resize(flat_.size());
  lane_slopes_.resize(flat_.size());
  for (const TestAngle& test : model.tests()) {
    FoldState<T>& base = base_.emplace_back(state_);
    for (int i = 0; i < kLanes<T>; ++i) put_lane(test.base, base, i);
    base_factors_.emplace_back(test.factors);
    lengths_per_closure_.emplace_back(test.lengths_per_closure.begin(),
                                      test.lengths_per_closure.end());
    rounding_.push_back(rounding_error(std::numeric_limits<Real>::epsilon(), model.extent(), test));
  }
  const double* const flat_mm = model.base().sheet.vertices_mm.data();
  for (int v = 0; v < mechanism_.vertices; ++v) {
    const double x_mm = flat_mm[2 * v] - flat_mm[0], y_mm = flat_mm[2 * v + 1] - flat_mm[1];
    base_x_.push_back(T(static_cast<Real>(x_mm / mechanism_.panel_width_mm)));
    base_y_.push_back(T(static_cast<Real>(y_mm / mechanism_.panel_width_mm)));
  }
  geometry_ = lane_geometry<T>(mechanism_);
  geometry_.x = base_x_;
  geometry_.y = base_y_;
}

// Empty lanes repeat the first sheet.
template <class T>
void LaneTest<T>::load(const ShiftBlock& block, const OpenSheet* open, int count) {
  using std::sqrt;
  const T per_width(static_cast<Real>(1 / mechanism_.panel_width_mm));
  std::array<const double*, kLanes<T>> shifts;
  for (int i = 0; i < kLanes<T>; ++i) shifts[i] = block.of(open[i < count ? i : 0].sheet);
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
void LaneTest<T>::solve(int test) {
  const int n = mechanism_.equations;
  const SparseLu<Real>& factors = base_factors_[test];
  const bool with_slopes = model_.tests()[test].with_slopes;
  state_ = base_[test];
  evaluate(mechanism_, geometry_, state_, residual_.data(), nullptr);
  factors.forward(residual_.data(), y_.data());
  factors.backward(y_.data(), y_[n - 1] / T(factors.partner_coefficient()), T(0), turn_.data());
  for (T& turn : turn_) turn = -turn;
  advance(mechanism_, turn_.data(), state_);
  first_correction_ = correct(true);
  second_correction_ = correct(with_slopes);
  determinant_sign_ = lu_.determinant_sign();
  if (with_slopes) {
    lu_.null_vector(-lu_.pilot_coefficient() / lu_.partner_coefficient(), T(1), y_.data(),
                    turn_.data());
    folded_lengths_and_slopes(mechanism_, geometry_, state_, turn_.data(), lengths_.data(),
                              slopes_.data(), residual_.data());
    slope_correction_ = correct_slopes(test);
  } else {
    folded_lengths(mechanism_, geometry_, state_, lengths_.data());
  }
}

// One correction with the pilot held, by new factors or those that are there; returns the largest
// turn it made.
template <class T>
T LaneTest<T>::correct(bool new_factors) {
  if (new_factors) {
    evaluate(mechanism_, geometry_, state_, residual_.data(), lu_.entries());
    lu_.factorize();
  } else {
    evaluate(mechanism_, geometry_, state_, residual_.data(), nullptr);
  }
  lu_.forward(residual_.data(), y_.data());
  lu_.backward(y_.data(), y_[mechanism_.equations - 1] / lu_.partner_coefficient(), T(0),
               turn_.data());
  T largest(0);
  for (T& turn : turn_) {
    turn = -turn;
    largest = larger(largest, magnitude(turn));
  }
  advance(mechanism_, turn_.data(), state_);
  return largest;
}

// Takes off what the tangent's misfit adds to the slopes, weighted as on the base folding; returns
// the largest change.
template <class T>
T LaneTest<T>::correct_slopes(int test) {
  T largest(0);
  const Real* weight = lengths_per_closure_[test].data();
  for (T& slope : slopes_) {
    T sum(0);
    for (const T& misfit : residual_) sum = sum + T(*weight++) * misfit;
    slope = slope - sum;
    largest = larger(largest, magnitude(sum));
  }
  return largest;
}

template <class T>
template <class Rules, class Approach>
void LaneTest<T>::report(int test, OpenSheet* open, int count, Rules& rules, Approach& approach) {
  const TestAngle& angle = model_.tests()[test];
  if (test == 0) flat_lengths(mechanism_, geometry_, flat_.data());
  for (int i = 0; i < count; ++i) {
    const int sheet = open[i].sheet;
    if (test == 0) {
      for (std::size_t k = 0; k < flat_.size(); ++k) lane_flat_[k] = lane(flat_[k], i);
      rules.set_flat(sheet, lane_flat_.data());
    }
    effort_.solves += 1;
    effort_.iterations += angle.with_slopes ? 2 : 1;
    const double first = lane(first_correction_, i), second = lane(second_correction_, i);
    const auto error = angle.with_slopes ? newton_error(first, second, model_.length_per_rad())
                                         : chord_error(first, second, model_.length_per_rad());
    if (!error || (lane(determinant_sign_, i) < 0) != (angle.determinant_sign < 0)) continue;
    for (std::size_t k = 0; k < lengths_.size(); ++k) {
      lane_lengths_[k] = lane(lengths_[k], i);
      lane_slopes_[k] = lane(slopes_[k], i);
    }
    rules.observe(sheet, {angle.sample, lane_lengths_.data(), *error + rounding_[test],
                          angle.with_slopes ? lane_slopes_.data() : nullptr,
                          slope_error(lane(slope_correction_, i)) + rounding_[test]});
    if ((test == model_.departs_from() || open[i].kept_state < 0) && !rules.decided(sheet)) {
      copy_lane(state_, i, approach.keep(test, open[i]));
    }
  }
}

}  // namespace misalign::solver
