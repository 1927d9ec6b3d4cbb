// The smallest singular value of the square Jacobian, from factors that are there already.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace misalign::solver {

/// Inverse iteration on J J^T, started from the last answer: along a path few steps are needed.
class SmallestSingularValue {
 public:
  explicit SmallestSingularValue(Eigen::Index size)
      : direction_(Eigen::VectorXd::LinSpaced(size, 1.0, 2.0).normalized()) {}

  /// `factors` of J have `solve` and `solve_transposed`. Relative error below 1e-6 (tested against
  /// an SVD), unless J is singular: then 0.
  template <class Factors>
  double of(Factors& factors) {
    constexpr int kMostIterations = 500;
    constexpr double kRelativeChange = 1e-8;
    double inverse = 0;
    for (int k = 0; k < kMostIterations; ++k) {
      next_ = factors.solve(direction_);
      const double norm = next_.norm();
      if (!std::isfinite(norm)) return 0;
      const bool settled = std::abs(norm - inverse) <= kRelativeChange * norm;
      inverse = norm;
      next_ /= norm;  // solve_transposed squares the condition; keep the numbers in range
      direction_ = factors.solve_transposed(next_);
      direction_.normalize();
      if (settled) break;
    }
    return 1 / inverse;
  }

 private:
  Eigen::VectorXd direction_, next_;
};

}  // namespace misalign::solver
