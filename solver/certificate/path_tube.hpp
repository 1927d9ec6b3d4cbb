// A proven interval of a folding path: a polynomial with a box round it, in which every pilot angle
// of the interval has exactly one folded state.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/certificate/interval_chart.hpp"

namespace misalign::solver {

/// Powers of s in p, in the steps towards it, in J along it, and in C. They give intervals of some
/// 7 degrees for 6 x 6, limited by both p and C J (results/certificates/candidates.md).
inline constexpr int kPathDegree = 9, kHalfDegree = 4, kJacobianDegree = 5;
inline constexpr int kInversePowers = 3;
using PathModel = TaylorModel<kPathDegree>;
using JacobianModel = TaylorModel<kJacobianDegree>;

/// A proven interval.
struct PathTube {
  IntervalChart chart;
  std::vector<PathModel> path;  ///< p, all unknowns but the pilot's, with their errors
  Eigen::VectorXd radii;        ///< r: there is one state only within p +- r
  double contraction = 0;       ///< norm of |I - C J| weighted by r; below 1

  /// The box that the certificate claims: smaller than that of X round the path, so that it also
  /// holds for the coordinates of the kept state, which are rounded to 1e-7.
  double isolation() const;
};

/// Returns whether one tube ends in the state in which the next begins: the former's enclosure lies
/// within the latter's boxes.
bool join(const PathTube& before, const PathTube& after);

}  // namespace misalign::solver
