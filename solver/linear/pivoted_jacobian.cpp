#include "solver/linear/pivoted_jacobian.hpp"

#include <cassert>
#include <limits>

namespace misalign::solver {

using Eigen::VectorXd;

namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace

PivotedJacobian::PivotedJacobian(const ClosureSystem& system) : system_(system) {
  if (!is_sparse(system.mechanism())) dense_.emplace(size());
}

void PivotedJacobian::factorize(int held) {
  if (dense_) {
    assert(held == system_.mechanism().equations);
    dense_->factorize(system_.jacobian().leftCols(size()));
    return;
  }
  if (held != held_) lay_out(held);
  for (std::size_t k = 0; k < value_of_.size(); ++k) {
    matrix_.valuePtr()[k] = system_.values()[value_of_[k]];
  }
  lu_.factorize(matrix_);
}

// Places of the nonzeros without the held column, and the order of elimination that they give.
void PivotedJacobian::lay_out(int held) {
  held_ = held;
  std::vector<Eigen::Triplet<double>> numbers;  // in each place the number of its value
  for (std::size_t k = 0; k < system_.entries().size(); ++k) {
    const auto [row, column] = system_.entries()[k];
    if (column == held) continue;
    numbers.emplace_back(row, column > held ? column - 1 : column, static_cast<double>(k));
  }
  matrix_.resize(size(), size());
  matrix_.setFromTriplets(numbers.begin(), numbers.end());
  const auto number_of = matrix_.coeffs();
  value_of_.assign(number_of.begin(), number_of.end());
  lu_.analyzePattern(matrix_);
}

VectorXd PivotedJacobian::solve(const VectorXd& rhs) {
  if (dense_) return dense_->solve(rhs);
  if (lu_.info() != Eigen::Success) return VectorXd::Constant(size(), kNotANumber);
  return lu_.solve(rhs);
}

VectorXd PivotedJacobian::solve_transposed(const VectorXd& rhs) {
  if (dense_) return dense_->solve_transposed(rhs);
  if (lu_.info() != Eigen::Success) return VectorXd::Constant(size(), kNotANumber);
  return lu_.transpose().solve(rhs);
}

int PivotedJacobian::determinant_sign() {
  if (dense_) return dense_->determinant_sign();
  return lu_.info() == Eigen::Success ? static_cast<int>(lu_.signDeterminant()) : 0;
}

}  // namespace misalign::solver
