// Maximizes a linear function under linear bounds that zero satisfies, by the simplex method on a
// dense tableau. It adds, multiplies and divides in a fixed order, so that the answer is the same
// on every machine.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/pattern/null_space.hpp"

namespace misalign::solver {

/// Maximize gain . x where x >= 0 and rows x <= bounds, all of them >= 0.
struct LinearProgram {
  RowMatrix rows;
  Eigen::VectorXd bounds;
  Eigen::VectorXd gain;
};

struct LinearOptimum {
  enum class StopReason { optimal, unbounded, too_long };

  StopReason end;
  Eigen::VectorXd x;
  double value = 0;
  std::vector<int> binding;  ///< rows whose bounds limit the value, ascending
  int pivots = 0;
  Eigen::VectorXd price;  ///< per row: gain of the value per unit of its bound
};

LinearOptimum maximize(const LinearProgram& program);

}  // namespace misalign::solver
