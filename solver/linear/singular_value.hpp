// Finds the smallest singular value of the square Jacobian from existing factors.
#pragma once

#include <cmath>
#include <vector>

#include "solver/kinematics/lane_math.hpp"

namespace misalign::solver {

/// Inverse iteration on J J^T starts from the last vector: along a path few steps are needed. Each
/// lane stops by itself, so that its result does not depend on its neighbours.
template <class T>
class SmallestSingularValue {
 public:
  explicit SmallestSingularValue(int size) : direction_(size), next_(size), other_(size) {
    for (int i = 0; i < kLanes<T>; ++i) restart(i);
  }

  /// Forgets the last vector of a lane.
  void restart(int i) {
    const double size = static_cast<double>(direction_.size());
    for (std::size_t k = 0; k < direction_.size(); ++k) {
      lane(direction_[k], i) = (1 + static_cast<double>(k) / size) / size;
    }
  }

  /// `factors` of J have `solve(rhs, x)` and `solve_transposed(rhs, x)`. Relative error below 1e-6
  /// (tested against an SVD) plus that of the factors. 0 or not a number if J is singular. Only
  /// lanes that are positive in `wanted` are computed.
  template <class Factors>
  T of(Factors& factors, const T& wanted = T(1)) {
    constexpr int kMostIterations = 500;
    constexpr double kRelativeChange = 1e-6;
    T inverse(0), open = wanted;
    for (int k = 0; k < kMostIterations && any_positive(open); ++k) {
      const auto is_open = open > T(0);
      factors.solve(direction_.data(), next_.data());
      const T norm = scale_to_one(next_);  // solve_transposed squares the condition
      factors.solve_transposed(next_.data(), other_.data());
      scale_to_one(other_);
      for (std::size_t j = 0; j < direction_.size(); ++j) {
        direction_[j] = select(is_open, other_[j], direction_[j]);
      }
      const auto moves = magnitude(norm - inverse) > T(kRelativeChange) * norm;
      inverse = select(is_open, norm, inverse);
      open = select(moves, open, T(0));
    }
    return T(1) / inverse;
  }

 private:
  static bool any_positive(const T& values) {
    for (int i = 0; i < kLanes<T>; ++i) {
      if (lane(values, i) > 0) return true;
    }
    return false;
  }

  // Scales a vector to length one and returns its former length.
  static T scale_to_one(std::vector<T>& vector) {
    using std::sqrt;
    T square(0);
    for (const T& entry : vector) square = square + entry * entry;
    const T norm = sqrt(square), scale = T(1) / norm;
    for (T& entry : vector) entry = entry * scale;
    return norm;
  }

  std::vector<T> direction_, next_, other_;
};

}  // namespace misalign::solver
