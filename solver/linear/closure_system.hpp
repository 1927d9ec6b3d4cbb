// Loop closure at a state: its residual and its Jacobian, as nonzeros and as a dense matrix.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/kinematics/loop_closure.hpp"
#include "solver/kinematics/loose_sheet.hpp"

namespace misalign::solver {

/// Equations and their Jacobian at one state; owns its memory from the start, but for the dense
/// matrix, which is made where it is asked for.
class ClosureSystem {
 public:
  /// `mechanism` must outlive this object.
  explicit ClosureSystem(const Mechanism& mechanism);

  /// Residual and Jacobian at `state`; returns the opening of the worst loop.
  double evaluate(const SheetGeometry<double>& geometry, const FoldState<double>& state);
  double evaluate(const LooseSheet<double>& sheet, const FoldState<double>& state);

  const Mechanism& mechanism() const { return mechanism_; }
  const Eigen::VectorXd& residual() const { return residual_; }
  /// Places of the Jacobian's structural nonzeros, no place twice, and their values.
  std::span<const JacobianEntry> entries() const { return entries_; }
  std::span<const double> values() const { return values_; }
  /// equations x unknowns, the pilot's column last.
  const Eigen::MatrixXd& jacobian() const;
  /// The Jacobian's column of one unknown.
  Eigen::VectorXd column(int unknown) const;

 private:
  template <class Geometry>
  double evaluate_at(const Geometry& geometry, const FoldState<double>& state);

  const Mechanism& mechanism_;
  std::vector<JacobianEntry> entries_;
  std::vector<double> values_;
  Eigen::VectorXd residual_;
  mutable Eigen::MatrixXd jacobian_;
  mutable bool is_jacobian_old_ = true;
};

}  // namespace misalign::solver
