// A proven interval of a folding path: a polynomial, and round it a box in which there is exactly
// one folded state for every pilot angle of the interval.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/certificate/interval_chart.hpp"

namespace misalign::solver {

/// Powers of s in p, in the steps towards it, in J along it, and in C. With these intervals of 6 x
/// 6 are some 7 degrees long, and neither p nor C J alone limits that
/// (results/certificates/candidates.md).
inline constexpr int kPathDegree = 9, kHalfDegree = 4, kJacobianDegree = 5;
inline constexpr int kInversePowers = 3;
using PathModel = TaylorModel<kPathDegree>;
using JacobianModel = TaylorModel<kJacobianDegree>;

/// A proven interval.
struct PathTube {
  IntervalChart chart;
  std::vector<PathModel> path;  ///< every unknown but the pilot's: p, and by how much it may be off
  Eigen::VectorXd radii;        ///< r: within p +- r there is one state only
  double contraction = 0;       ///< of |I - C J| in the norm that r makes; below 1

  /// The box that the certificate claims: less than that of X round the path, so that it holds for
  /// the coordinates of the state that is kept too, which are off by 1e-7.
  double isolation() const;
};

/// Whether the state in which one tube ends is the one in which the next begins: the former's
/// enclosure lies within the latter's boxes.
bool join(const PathTube& before, const PathTube& after);

}  // namespace misalign::solver
