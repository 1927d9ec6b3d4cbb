// KINSOL (SUNDIALS) on the same residual: what a user would otherwise pick.
#pragma once

#include "tests/bench/work_precision/problem.hpp"

namespace misalign::bench {

struct KinsolOptions {
  bool analytic = true;  ///< otherwise its own difference quotients
  /// Newton steps on one Jacobian before it is made anew; 0: KINSOL's default, ten.
  long steps_a_jacobian = 0;
};

/// Steps as wide as the samples' spacing, each from the solution before; the unknowns are the small
/// rotations of every joint since then. The tolerance is that of the residual's largest entry.
Run kinsol_steps(const Problem& problem, const Demand& demand, const KinsolOptions& options);

}  // namespace misalign::bench
