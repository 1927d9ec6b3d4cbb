// The smallest singular value of the square Jacobian, from factors that are there already.
#pragma once

#include "solver/newton.hpp"

namespace misalign::solver {

/// Inverse iteration on J J^T, started from the last answer: along a path few steps are needed.
class SmallestSingularValue {
 public:
  explicit SmallestSingularValue(Eigen::Index size)
      : direction_(Eigen::VectorXd::LinSpaced(size, 1.0, 2.0).normalized()) {}

  /// `factors` of J; relative error below 1e-6 (tested against an SVD), unless J is singular: then
  /// 0.
  double of(DenseSolve& factors);

 private:
  Eigen::VectorXd direction_, next_;
};

}  // namespace misalign::solver
