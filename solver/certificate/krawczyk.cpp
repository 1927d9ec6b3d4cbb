#include "solver/certificate/krawczyk.hpp"

#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

/// Least entry of r over the largest: every box must be of use.
constexpr double kLeastWeight = 0.05;

}  // namespace

Krawczyk::Krawczyk(const Mechanism& mechanism) : columns_(mechanism.equations) {
  assert(kInversePowers * mechanism.equations + 100 < kMostOperations);
  const int pilot = mechanism.creases[mechanism.pilot].column;
  int value = 0;
  for (const Loop& loop : mechanism.loops) {
    for (const Passage& passage : loop.passages) {
      for (int k = 0; k < (passage.ball ? 3 : 1); ++k) {
        const int column = mechanism.first_column(passage) + k;
        if (column == pilot) continue;
        for (int row = 0; row < loop.rows; ++row) {
          columns_[column].rows.push_back(loop.first_row + row);
          columns_[column].values.push_back(value++);
        }
      }
    }
  }
}

Eigen::MatrixXd Krawczyk::inverse_of(const std::vector<double>& jacobian) const {
  const Eigen::Index n = std::ssize(columns_);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < columns_[j].rows.size(); ++k) {
      matrix(columns_[j].rows[k], j) = jacobian[columns_[j].values[k]];
    }
  }
  return matrix.partialPivLu().inverse();
}

void Krawczyk::set_ends(const Eigen::MatrixXd& low, const Eigen::MatrixXd& high, double s) {
  inverse_[1] = (high - low) / (2 * s);
  inverse_[2] = (high + low - 2 * inverse_[0]) / (2 * s * s);
  absolute_inverse_ = inverse_[0].cwiseAbs() + inverse_[1].cwiseAbs() + inverse_[2].cwiseAbs();
}

void Krawczyk::bound_deviation(const std::vector<JacobianModel>& jacobian) {
  const Eigen::Index n = std::ssize(columns_);
  deviation_.resize(n, n);
  Eigen::MatrixXd sums(n, kJacobianDegree + kInversePowers);
  for (Eigen::Index j = 0; j < n; ++j) {
    sums.setZero();
    Eigen::VectorXd most = Eigen::VectorXd::Zero(n);
    const std::size_t entries = columns_[j].rows.size();
    for (std::size_t e = 0; e < entries; ++e) {
      const JacobianModel& value = jacobian[columns_[j].values[e]];
      const int row = columns_[j].rows[e];
      for (int power = 0; power < kInversePowers; ++power) {
        for (int k = 0; k <= kJacobianDegree; ++k) {
          sums.col(power + k) += value.c[k] * inverse_[power].col(row);
        }
      }
      const double operations = static_cast<double>(kInversePowers * entries + 2);
      most += (value.radius + operations * kUnit * value.size()) * absolute_inverse_.col(row);
    }
    sums(j, 0) -= 1;
    most[j] += 2 * kUnit;  // rounding of that, which is below 2
    if (!(std::abs(sums(j, 0)) < 1)) most[j] = std::numeric_limits<double>::infinity();
    for (int k = 0; k < sums.cols(); ++k) most += sums.col(k).cwiseAbs();
    deviation_.col(j) = rounded_up(most);
  }
}

Eigen::VectorXd Krawczyk::find_weights() const {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(deviation_.rows());
  for (int k = 0; k < 8; ++k) {
    const Eigen::VectorXd image = deviation_ * weights;
    weights = (image / image.maxCoeff()).cwiseMax(kLeastWeight);
  }
  return weights;
}

Eigen::VectorXd Krawczyk::bound_product(const std::vector<PathModel>& residual) const {
  const int n = static_cast<int>(residual.size());
  Eigen::VectorXd most = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, kPathDegree + kInversePowers);
  for (int j = 0; j < n; ++j) {
    for (int power = 0; power < kInversePowers; ++power) {
      for (int k = 0; k <= kPathDegree; ++k) {
        sums.col(power + k) += residual[j].c[k] * inverse_[power].col(j);
      }
    }
    most += (residual[j].radius + (kInversePowers * n + 2) * kUnit * residual[j].size()) *
            absolute_inverse_.col(j);
  }
  for (int k = 0; k < sums.cols(); ++k) most += sums.col(k).cwiseAbs();
  return rounded_up(most);
}

Eigen::VectorXd Krawczyk::times_deviation(const Eigen::VectorXd& radii) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(radii.size());
  for (Eigen::Index j = 0; j < radii.size(); ++j) sum += radii[j] * deviation_.col(j);
  return rounded_up(sum);
}

// The bound in the norm of r is at most that of `most` / (1 - contraction); applying the inequality
// to a bound gives another.
Eigen::VectorXd Krawczyk::bound_solution(const PathTube& tube, const Eigen::VectorXd& most) const {
  if (!most.allFinite()) {
    return Eigen::VectorXd::Constant(most.size(), std::numeric_limits<double>::infinity());
  }
  const double largest = (most.array() / tube.radii.array()).maxCoeff();
  Eigen::VectorXd errors = rounded_up(kUp * (largest / (1 - tube.contraction)) * tube.radii);
  for (int k = 0; k < 2; ++k) errors = errors.cwiseMin(rounded_up(most + times_deviation(errors)));
  return errors;
}

}  // namespace misalign::solver
