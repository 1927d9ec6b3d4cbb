// Minimizes a convex quadratic function within a box, where rows may be violated at a price, by a
// primal-dual interior point method (Nocedal and Wright 2006, section 16.6). It adds, multiplies,
// divides and takes roots in a fixed order.
#pragma once

#include <Eigen/Core>

namespace misalign::solver {

/// Minimize x . hessian x / 2 + gradient . x + penalty * (sum of the violations) with
/// -fall <= x <= rise. Row k is violated by what slacks(k) + rows.row(k) . x lies below 0.
struct QuadraticProgram {
  Eigen::MatrixXd hessian;  ///< symmetric, not indefinite
  Eigen::VectorXd gradient;
  Eigen::MatrixXd rows;
  Eigen::VectorXd slacks;
  Eigen::ArrayXd fall, rise;  ///< not negative, and not both 0
  double penalty;
};

struct QuadraticOptimum {
  bool is_found;
  Eigen::VectorXd x;
  double value;           ///< the function's, penalty included
  Eigen::VectorXd price;  ///< per row: fall of the value per unit of its slack, at most the penalty
};

QuadraticOptimum minimize(const QuadraticProgram& program);

}  // namespace misalign::solver
