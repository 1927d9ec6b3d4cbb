// A fast test: as many sheets as there are lanes, all at one angle, straight from the base folding.
// One step with the base's factors, then two corrections: the second one's size against the first
// one's tells how far away the solution still is. Where slopes are wanted both are Newton's, with
// factors of their own; otherwise the second uses the first one's.
#pragma once

#include <array>

#include "solver/diagonals.hpp"
#include "solver/lane_desk.hpp"
#include "solver/lane_math.hpp"

namespace misalign::solver {

/// A sheet that is not decided yet, and its state kept for the approach; -1: none is trusted.
struct OpenSheet {
  int sheet, kept_state;
};

template <class T>
class LaneTest {
 public:
  explicit LaneTest(const SheetFamily& family);

  /// Looks at every open sheet at the angle of the test with this index; keeps the first trusted
  /// state of those that it does not decide.
  void run(int test, const ShiftBlock& block, std::vector<OpenSheet>& open, Screening& screening,
           ApproachDesk& approach) {
    for (std::size_t first = 0; first < open.size(); first += kLanes<T>) {
      const int count = static_cast<int>(std::min<std::size_t>(kLanes<T>, open.size() - first));
      load(block, open.data() + first, count);
      solve(test);
      report(test, open.data() + first, count, screening, approach);
    }
  }

  const Effort& effort() const { return effort_; }

 private:
  void load(const ShiftBlock& block, const OpenSheet* open, int count);
  MISALIGN_FLATTEN void solve(int test);
  MISALIGN_FLATTEN T correct(bool new_factors);
  void report(int test, OpenSheet* open, int count, Screening& screening, ApproachDesk& approach);

  const SheetFamily& family_;
  const Mechanism& mechanism_;
  using Real = Scalar<T>;

  std::vector<FoldState<T>> base_;            // per test, in every lane
  std::vector<SparseLu<Real>> base_factors_;  // per test
  std::vector<T> base_x_, base_y_;            // panel widths
  SheetGeometry<T> geometry_;
  FoldState<T> state_;
  std::vector<T> residual_, y_, turn_, flat_, lengths_, slopes_;
  SparseLu<T> lu_;
  T first_correction_, second_correction_, determinant_sign_;
  std::vector<double> lane_flat_, lane_lengths_, lane_slopes_;
  Effort effort_;
};

template <class T>
LaneTest<T>::LaneTest(const SheetFamily& family)
    : family_(family),
      mechanism_(family.mechanism()),
      state_(flat_state<T>(mechanism_)),
      residual_(mechanism_.equations, T(0)),
      y_(mechanism_.unknowns, T(0)),
      turn_(mechanism_.unknowns, T(0)),
      flat_(mechanism_.diagonals.size(), T(0)),
      lengths_(flat_),
      slopes_(flat_),
      lu_(family.elimination()) {
  lane_flat_.resize(flat_.size());
  lane_lengths_.resize(flat_.size());
  lane_slopes_.resize(flat_.size());
  for (const TestAngle& test : family.tests()) {
    FoldState<T>& base = base_.emplace_back(state_);
    for (int i = 0; i < kLanes<T>; ++i) put_lane(test.base, base, i);
    base_factors_.emplace_back(test.factors);
  }
  const double* const flat_mm = family.base().sheet.vertices_mm.data();
  for (int v = 0; v < mechanism_.vertices; ++v) {
    base_x_.push_back(T(static_cast<Real>(flat_mm[2 * v] / mechanism_.panel_width_mm)));
    base_y_.push_back(T(static_cast<Real>(flat_mm[2 * v + 1] / mechanism_.panel_width_mm)));
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
  for (const int vertex : family_.shifted()) {
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
  const bool with_slopes = family_.tests()[test].with_slopes;
  state_ = base_[test];
  evaluate(mechanism_, geometry_, state_, residual_.data(), nullptr);
  factors.forward(residual_.data(), y_.data());
  factors.backward(y_.data(), y_[n - 1] / T(factors.partner_coefficient()), T(0), turn_.data());
  for (T& turn : turn_) turn = -turn;
  advance(mechanism_, turn_.data(), state_);
  first_correction_ = correct(true);
  second_correction_ = correct(with_slopes);
  determinant_sign_ = T(static_cast<Real>(lu_.plan().permutation_sign));
  for (int k = 0; k < n; ++k) {
    determinant_sign_ = select(lu_.pivot(k) < T(0), -determinant_sign_, determinant_sign_);
  }
  if (with_slopes) {
    lu_.null_vector(-lu_.pilot_coefficient() / lu_.partner_coefficient(), T(1), y_.data(),
                    turn_.data());
    folded_lengths_and_slopes(mechanism_, geometry_, state_, turn_.data(), lengths_.data(),
                              slopes_.data());
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

template <class T>
void LaneTest<T>::report(int test, OpenSheet* open, int count, Screening& screening,
                         ApproachDesk& approach) {
  const TestAngle& angle = family_.tests()[test];
  if (test == 0) flat_lengths(mechanism_, geometry_, flat_.data());
  for (int i = 0; i < count; ++i) {
    const int sheet = open[i].sheet;
    if (test == 0) {
      for (std::size_t k = 0; k < flat_.size(); ++k) lane_flat_[k] = lane(flat_[k], i);
      screening.set_flat(sheet, lane_flat_.data());
    }
    effort_.solves += 1;
    effort_.iterations += angle.with_slopes ? 2 : 1;
    const double first = lane(first_correction_, i), second = lane(second_correction_, i);
    const StateError error = angle.with_slopes
                                 ? newton_error(first, second, family_.length_per_rad())
                                 : chord_error(first, second, family_.length_per_rad());
    if (!error.known || lane(determinant_sign_, i) * angle.determinant_sign < 0) continue;
    for (std::size_t k = 0; k < lengths_.size(); ++k) {
      lane_lengths_[k] = lane(lengths_[k], i);
      lane_slopes_[k] = lane(slopes_[k], i);
    }
    screening.observe(sheet, {angle.sample, lane_lengths_.data(), error.length,
                              angle.with_slopes ? lane_slopes_.data() : nullptr, error.slope});
    if (open[i].kept_state < 0 && !screening.decided(sheet)) {
      copy_lane(state_, i, approach.keep(test, open[i].kept_state));
    }
  }
}

}  // namespace misalign::solver
