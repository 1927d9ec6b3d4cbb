// Linear solvers for Newton's step, one type each: made once for a topology, then factorized at
// every step. One more solver is one more type with these two functions and a name.
#pragma once

#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <memory>
#include <type_traits>
#include <vector>

#include "solver/kinematics/loop_closure.hpp"
#include "solver/linear/pivot_order.hpp"
#include "solver/linear/sparse_lu.hpp"

namespace misalign::bench {

/// What a linear solver may be made from.
struct Topology {
  const solver::Mechanism& mechanism;
  const solver::BaseFolding& folding;
  const solver::FlatVertices& base_vertices_mm;
};

/// PartialPivLU as in solver::Newton, with factors in S, whatever the residual is in.
template <class S>
class DenseLinear {
 public:
  static constexpr const char* kName = std::is_same_v<S, float> ? "dense LU in single" : "dense LU";

  explicit DenseLinear(const Topology& topology)
      : entries_(solver::jacobian_entries(topology.mechanism)),
        matrix_(Matrix::Zero(topology.mechanism.equations, topology.mechanism.equations)),
        lu_(topology.mechanism.equations),
        x_(topology.mechanism.equations) {}

  /// `values` in the order of jacobian_entries; the pilot's column is left out.
  template <class T>
  void factorize(const T* values) {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (entries_[k].column == matrix_.cols()) continue;
      matrix_(entries_[k].row, entries_[k].column) = static_cast<S>(values[k]);
    }
    lu_.compute(matrix_);
  }

  /// x with matrix * x = rhs.
  template <class T>
  void solve(const T* rhs, T* x) {
    const Eigen::Map<const Eigen::Vector<T, Eigen::Dynamic>> b(rhs, matrix_.cols());
    x_.noalias() = lu_.permutationP() * b.template cast<S>();
    lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(x_);
    lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(x_);
    Eigen::Map<Eigen::Vector<T, Eigen::Dynamic>>(x, matrix_.cols()) = x_.template cast<T>();
  }

 private:
  using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  std::vector<solver::JacobianEntry> entries_;
  Matrix matrix_;
  Eigen::PartialPivLU<Matrix> lu_;
  Eigen::Vector<S, Eigen::Dynamic> x_;
};

/// Eigen::SparseLU with column ordering (COLAMD), analysed once: what one would take off the shelf.
class EigenSparseLinear {
 public:
  static constexpr const char* kName = "Eigen SparseLU";

  explicit EigenSparseLinear(const Topology& topology)
      : matrix_(topology.mechanism.equations, topology.mechanism.equations),
        x_(topology.mechanism.equations) {
    const int equations = topology.mechanism.equations;
    const auto entries = solver::jacobian_entries(topology.mechanism);
    std::vector<Eigen::Triplet<double>> places;
    for (const solver::JacobianEntry& entry : entries) {
      if (entry.column < equations) places.emplace_back(entry.row, entry.column, 1.0);
    }
    matrix_.setFromTriplets(places.begin(), places.end());
    matrix_.makeCompressed();
    for (const solver::JacobianEntry& entry : entries) {
      slot_.push_back(entry.column < equations ? &matrix_.coeffRef(entry.row, entry.column)
                                               : nullptr);
    }
    lu_.analyzePattern(matrix_);
  }

  void factorize(const double* values) {
    for (std::size_t k = 0; k < slot_.size(); ++k) {
      if (slot_[k]) *slot_[k] = values[k];
    }
    lu_.factorize(matrix_);
  }

  void solve(const double* rhs, double* x) {
    x_ = lu_.solve(Eigen::Map<const Eigen::VectorXd>(rhs, matrix_.cols()));
    Eigen::Map<Eigen::VectorXd>(x, matrix_.cols()) = x_;
  }

 private:
  Eigen::SparseMatrix<double> matrix_;
  std::vector<double*> slot_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
  Eigen::VectorXd x_;
};

/// solver::SparseLu with factors in S: the order fixed once for the topology.
template <class S>
class FixedOrderLinear {
 public:
  static constexpr const char* kName =
      std::is_same_v<S, float> ? "fixed order in single" : "fixed order";

  explicit FixedOrderLinear(const Topology& topology)
      : plan_(std::make_unique<solver::Elimination>(solver::plan_elimination(
            topology.mechanism, topology.folding, topology.base_vertices_mm))),
        lu_(*plan_),
        rhs_(static_cast<std::size_t>(plan_->equations)),
        y_(rhs_.size() + 1),
        x_(rhs_.size() + 1) {}

  template <class T>
  void factorize(const T* values) {
    auto entry = lu_.entries();
    for (std::size_t k = 0; k < plan_->slot_of_value.size(); ++k) {
      *entry++ = static_cast<S>(values[k]);
    }
    lu_.factorize();
  }

  /// The pilot is held.
  template <class T>
  void solve(const T* rhs, T* x) {
    for (S& entry : rhs_) entry = static_cast<S>(*rhs++);
    lu_.forward(rhs_.data(), y_.data());
    const S partner = y_[rhs_.size() - 1] / lu_.partner_coefficient();
    lu_.backward(y_.data(), partner, S(0), x_.data());
    for (std::size_t i = 0; i < rhs_.size(); ++i) x[i] = static_cast<T>(x_[i]);
  }

 private:
  std::unique_ptr<solver::Elimination> plan_;  // stays where it is
  solver::SparseLu<S> lu_;
  std::vector<S> rhs_, y_, x_;
};

}  // namespace misalign::bench
