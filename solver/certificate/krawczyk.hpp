// Krawczyk's operator of the loop closure F(x, s) = 0 along an interval: matrices C(s) near J^-1,
// and bounds of C F and of I - C J all over the interval.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "solver/certificate/path_tube.hpp"
#include "solver/kinematics/mechanism.hpp"

namespace misalign::solver {

class Krawczyk {
 public:
  /// An unknown's column of J: indices among the values of GradedClosure::evaluate, and their rows.
  struct Column {
    std::vector<int> rows, values;
  };

  explicit Krawczyk(const Mechanism& mechanism);

  /// The columns of every unknown but the pilot's.
  const std::vector<Column>& columns() const { return columns_; }
  Eigen::MatrixXd inverse_of(const std::vector<double>& jacobian) const;

  /// C, by powers of s: J^-1 in the middle, and the parabola through that and J^-1 at -s and s.
  const Eigen::MatrixXd& middle() const { return inverse_[0]; }
  void set_middle(Eigen::MatrixXd inverse) { inverse_[0] = std::move(inverse); }
  void set_ends(const Eigen::MatrixXd& low, const Eigen::MatrixXd& high, double s);

  /// Bounds |I - C J| for all values of J's entries.
  void bound_deviation(const std::vector<JacobianModel>& jacobian);
  const Eigen::MatrixXd& deviation() const { return deviation_; }
  /// Radii that the deviation contracts, the largest 1: its eigenvector, except for small entries.
  Eigen::VectorXd find_weights() const;

  /// Bounds |C F| from above.
  Eigen::VectorXd bound_product(const std::vector<PathModel>& residual) const;
  /// Bounds |I - C J| times these radii.
  Eigen::VectorXd times_deviation(const Eigen::VectorXd& radii) const;
  /// Bounds |e| for every e with |e| <= most + |I - C J| |e|, on a tube that is proven.
  Eigen::VectorXd bound_solution(const PathTube& tube, const Eigen::VectorXd& most) const;

 private:
  std::vector<Column> columns_;
  std::array<Eigen::MatrixXd, kInversePowers> inverse_;
  Eigen::MatrixXd absolute_inverse_;  // at least |C| all over s
  Eigen::MatrixXd deviation_;         // at least |I - C J|
};

/// An upper bound of sums of nonnegative numbers, in a fixed order.
inline Eigen::VectorXd rounded_up(const Eigen::VectorXd& sums) {
  return kUp * sums.array() + kUnderflow;
}

}  // namespace misalign::solver
