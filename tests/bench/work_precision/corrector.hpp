// Newton-Raphson on loop closure with the pilot held, as solver::Newton does it, over any scalar,
// any linear solver and either Jacobian.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "solver/kinematics/loop_closure.hpp"
#include "tests/bench/work_precision/linear.hpp"
#include "tests/bench/work_precision/problem.hpp"
#include "tests/bench/work_precision/scalar.hpp"

namespace misalign::bench {

enum class JacobianBy { analytic, forward_differences };

template <class T, class Linear>
class Corrector {
 public:
  Corrector(const Topology& topology, double tolerance, JacobianBy by = JacobianBy::analytic)
      : mechanism_(topology.mechanism),
        tolerance_(static_cast<T>(tolerance)),
        by_(by),
        entries_(solver::jacobian_entries(mechanism_)),
        linear_(topology),
        values_(entries_.size()),
        residual_(static_cast<std::size_t>(mechanism_.equations)),
        shifted_(residual_),
        entry_of_(residual_.size() * static_cast<std::size_t>(mechanism_.unknowns), -1),
        step_(static_cast<std::size_t>(mechanism_.unknowns), T(0)) {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      entry_of_[place(entries_[k].row, entries_[k].column)] = static_cast<int>(k);
    }
  }

  /// At least one correction, as in solver::Newton; false if `state` is not within the tolerance
  /// after fifteen.
  bool correct(const solver::SheetGeometry<T>& geometry, solver::FoldState<T>& state,
               Effort& effort) {
    for (int iteration = 0;; ++iteration) {
      const T open = evaluate(geometry, state, effort);
      if (!std::isfinite(open)) return false;
      if (open <= tolerance_ && iteration > 0) return true;
      if (iteration == kMaxIterations) return false;
      if (by_ == JacobianBy::forward_differences) take_differences(geometry, state, effort);
      linear_.factorize(values_.data());
      linear_.solve(residual_.data(), step_.data());
      step_.back() = T(0);  // the pilot is held
      T largest(0);
      for (T& entry : step_) {
        entry = -entry;
        largest = std::max(largest, std::abs(entry));
      }
      if (iteration == 0) first_correction_ = largest;
      solver::advance(mechanism_, step_.data(), state);
      ++effort.corrections;
    }
  }

  /// After `correct`: change of every unknown per radian of the pilot. The pilot's column is that
  /// of the solution, the factors those of the last correction: no further factorization, and an
  /// error in proportion to that correction. Analytic Jacobian only.
  void tangent(std::vector<T>& tangent) {
    const int pilot_column = mechanism_.unknowns - 1;
    std::fill(shifted_.begin(), shifted_.end(), T(0));
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (entries_[k].column == pilot_column) shifted_[entries_[k].row] = -values_[k];
    }
    linear_.solve(shifted_.data(), tangent.data());
    tangent.back() = T(1);
  }

  /// The same with factors of the solution's own Jacobian: one more factorization.
  void tangent_afresh(std::vector<T>& tangent) {
    linear_.factorize(values_.data());
    this->tangent(tangent);
  }

  /// How far `state` is open as it is.
  T open_by(const solver::SheetGeometry<T>& geometry, const solver::FoldState<T>& state,
            Effort& effort) {
    ++effort.evaluations;
    return solver::evaluate<T>(mechanism_, geometry, state, residual_.data(), nullptr);
  }

  /// How far the last start was from the solution: the largest entry of the first correction, rad.
  T first_correction() const { return first_correction_; }

 private:
  static constexpr int kMaxIterations = 15;

  std::size_t place(int row, int column) const {
    return static_cast<std::size_t>(column) * residual_.size() + static_cast<std::size_t>(row);
  }

  T evaluate(const solver::SheetGeometry<T>& geometry, const solver::FoldState<T>& state,
             Effort& effort) {
    ++effort.evaluations;
    if (by_ == JacobianBy::forward_differences) {
      return solver::evaluate<T>(mechanism_, geometry, state, residual_.data(), nullptr);
    }
    return solver::evaluate<T>(mechanism_, geometry, state, residual_.data(), values_.data());
  }

  // Column by column, one unknown turned by the square root of the rounding unit.
  void take_differences(const solver::SheetGeometry<T>& geometry, solver::FoldState<T>& state,
                        Effort& effort) {
    const T h = std::sqrt(std::numeric_limits<T>::epsilon());
    const auto fill = [&](int column) {
      ++effort.evaluations;
      solver::evaluate<T>(mechanism_, geometry, state, shifted_.data(), nullptr);
      for (int row = 0; row < mechanism_.equations; ++row) {
        const int k = entry_of_[place(row, column)];
        if (k >= 0) values_[k] = (shifted_[row] - residual_[row]) / h;
      }
    };
    for (std::size_t i = 0; i < mechanism_.creases.size(); ++i) {
      if (static_cast<int>(i) == mechanism_.pilot) continue;
      const solver::HalfAngle<T> kept = state.creases[i];
      state.creases[i] = kept.turned(h);
      fill(mechanism_.creases[i].column);
      state.creases[i] = kept;
    }
    for (std::size_t i = 0; i < mechanism_.balls.size(); ++i) {
      const solver::Quaternion<T> kept = state.balls[i];
      for (int axis = 0; axis < 3; ++axis) {
        const T half = T(0.5) * h;
        const solver::Quaternion<T> turn{T(1), axis == 0 ? half : T(0), axis == 1 ? half : T(0),
                                         axis == 2 ? half : T(0)};
        state.balls[i] = (turn * kept).normalized();
        fill(mechanism_.balls[i].column + axis);
      }
      state.balls[i] = kept;
    }
  }

  const solver::Mechanism& mechanism_;
  T tolerance_;
  JacobianBy by_;
  std::vector<solver::JacobianEntry> entries_;
  Linear linear_;
  std::vector<T> values_, residual_, shifted_;
  std::vector<int> entry_of_;  // index of the value at a place of the matrix, -1 where it is zero
  std::vector<T> step_;
  T first_correction_{};
};

}  // namespace misalign::bench
