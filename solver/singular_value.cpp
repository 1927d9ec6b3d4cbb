#include "solver/singular_value.hpp"

#include <cmath>

namespace misalign::solver {

double SmallestSingularValue::of(DenseSolve& factors) {
  constexpr int kMostIterations = 500;
  constexpr double kRelativeChange = 1e-10;
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

}  // namespace misalign::solver
