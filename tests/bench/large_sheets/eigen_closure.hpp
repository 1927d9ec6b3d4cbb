// Loop closure with Eigen's SparseLU (a port of SuperLU: column ordering, partial pivoting,
// blocks), for the same path follower: the Jacobian without the pilot's column is factored at every
// iteration, the residual and the pilot's column are solved for at once.
#pragma once

#include <Eigen/SparseLU>
#include <memory>
#include <vector>

#include "solver/kinematics/loop_closure.hpp"

namespace misalign::bench {

class EigenClosure {
 public:
  explicit EigenClosure(const solver::Mechanism& mechanism)
      : mechanism_(mechanism),
        entries_(solver::jacobian_entries(mechanism)),
        values_(entries_.size()),
        residual_(mechanism.equations),
        square_(mechanism.equations, mechanism.equations),
        rhs_(Eigen::MatrixXd::Zero(mechanism.equations, 2)),
        solution_(rhs_),
        lu_(std::make_unique<Lu>()) {
    std::vector<Eigen::Triplet<double>> places;
    for (const solver::JacobianEntry& entry : entries_) {
      if (entry.column < mechanism.equations) places.emplace_back(entry.row, entry.column, 1.0);
    }
    square_.setFromTriplets(places.begin(), places.end());
    for (const solver::JacobianEntry& entry : entries_) {
      const bool is_square = entry.column < mechanism.equations;
      place_.push_back(is_square ? &square_.coeffRef(entry.row, entry.column) - square_.valuePtr()
                                 : -1);
    }
    lu_->analyzePattern(square_);
  }

  void restart(int) {}

  double linearize(const solver::SheetGeometry<double>& geometry,
                   const solver::FoldState<double>& state) {
    const double open_by =
        solver::evaluate(mechanism_, geometry, state, residual_.data(), values_.data());
    for (std::size_t k = 0; k < values_.size(); ++k) {
      if (place_[k] < 0) {
        rhs_(entries_[k].row, 1) = -values_[k];
      } else {
        square_.valuePtr()[place_[k]] = values_[k];
      }
    }
    rhs_.col(0) = residual_;
    lu_->factorize(square_);
    solution_ = lu_->solve(rhs_);
    return open_by;
  }

  void solve(double, double* x, double* null) const {
    const Eigen::Index n = solution_.rows();
    Eigen::Map<Eigen::VectorXd>(x, n) = solution_.col(0);
    Eigen::Map<Eigen::VectorXd>(null, n) = solution_.col(1);
    x[n] = 0;
    null[n] = 1;
  }

  double orientation() const { return lu_->signDeterminant(); }

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  using Lu = Eigen::SparseLU<Sparse>;

  const solver::Mechanism& mechanism_;
  std::vector<solver::JacobianEntry> entries_;
  std::vector<double> values_;
  Eigen::VectorXd residual_;
  Sparse square_;
  std::vector<std::ptrdiff_t> place_;
  Eigen::MatrixXd rhs_, solution_;
  std::unique_ptr<Lu> lu_;  // neither copied nor moved
};

}  // namespace misalign::bench
