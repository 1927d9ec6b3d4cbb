// Makes one Newton iteration for one sheet in each lane: with the pilot held, or the shortest
// correction to the curve (Moore-Penrose; Allgower & Georg, Introduction to Numerical Continuation
// Methods, ch. 3). T = double, one sheet, is the definition: a lane has its bits.
#pragma once

#include <utility>
#include <vector>

#include "solver/kinematics/lane_state.hpp"
#include "solver/linear/sparse_closure.hpp"

namespace misalign::solver {

/// `Closure` is a SparseClosure<T>, or for T = double a PivotedClosure.
template <class T, class Closure>
class LaneCorrector {
 public:
  /// Owns its memory from the start; `mechanism` must outlive it.
  LaneCorrector(const Mechanism& mechanism, Closure closure)
      : mechanism_(mechanism),
        unknowns_(mechanism.unknowns),
        closure_(std::move(closure)),
        geometry_(lane_geometry<T>(mechanism)),
        trial_(flat_state<T>(mechanism)),
        correction_(mechanism.unknowns, T(0)),
        null_(correction_) {}

  /// Puts a sheet and its first trial state into lane i, with its pilot at `pilot`.
  void put(const SheetGeometry<double>& geometry, const FoldState<double>& state,
           const HalfAngle<double>& pilot, int i) {
    closure_.restart(i);
    put_lane(geometry, geometry_, i);
    put_lane(state, trial_, i);
    hold(pilot, i);
  }
  void hold(const HalfAngle<double>& pilot, int i) {
    lane(trial_.creases[mechanism_.pilot].c, i) = pilot.c;
    lane(trial_.creases[mechanism_.pilot].s, i) = pilot.s;
  }

  /// Corrects the trial states; lanes where `is_free` is positive may move their pilot. All results
  /// but the correction's size are those before the correction; angles are measured from
  /// `last_tangent`.
  void iterate(const T& is_free, const std::vector<T>& last_tangent) {
    open_ = closure_.linearize(geometry_, trial_);
    find_correction(is_free, last_tangent);
    largest_correction_ = T(0);
    for (T& turn : correction_) {
      turn = -turn;
      largest_correction_ = larger(largest_correction_, magnitude(turn));
    }
    advance(mechanism_, correction_.data(), trial_);
  }

  const Closure& closure() const { return closure_; }
  const SheetGeometry<T>& geometry() const { return geometry_; }
  FoldState<T>& trial() { return trial_; }
  const FoldState<T>& trial() const { return trial_; }
  /// The unit tangent from the factors, of either direction.
  const std::vector<T>& tangent() const { return null_; }
  const T& open_by() const { return open_; }
  const T& largest_correction() const { return largest_correction_; }
  /// Cosine of the angle between the tangent and the last one.
  const T& cosine() const { return cosine_; }
  /// Sign of det [J; t] for the tangent as it is.
  const T& orientation() const { return orientation_; }

 private:
  void find_correction(const T& is_free, const std::vector<T>& last_tangent) {
    using std::sqrt;
    closure_.solve(is_free, correction_.data(), null_.data());
    T square(0), along(0);
    cosine_ = T(0);
    for (int j = 0; j < unknowns_; ++j) {
      square = square + null_[j] * null_[j];
      along = along + null_[j] * correction_[j];
      cosine_ = cosine_ + null_[j] * last_tangent[j];
    }
    const T scale = T(1) / sqrt(square);
    cosine_ = cosine_ * scale;
    along = select(is_free > T(0), along / square, T(0));
    for (int j = 0; j < unknowns_; ++j) {
      correction_[j] = correction_[j] - along * null_[j];
      null_[j] = null_[j] * scale;
    }
    orientation_ = closure_.orientation();
  }

  const Mechanism& mechanism_;
  const int unknowns_;
  Closure closure_;
  SheetGeometry<T> geometry_;
  FoldState<T> trial_;
  std::vector<T> correction_, null_;
  T open_, largest_correction_, cosine_, orientation_;
};

}  // namespace misalign::solver
