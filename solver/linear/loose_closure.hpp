// Loop closure of a sheet whose joints have play, for a path follower: in the fixed order, or as
// equations for a DenseClosure. The geometry that the follower carries, of the same sheet as
// designed, is not looked at.
#pragma once

#include "solver/linear/dense_closure.hpp"
#include "solver/linear/sparse_closure.hpp"

namespace misalign::solver {

class LooseClosure {
 public:
  /// All must outlive this object; the sheet may change between paths.
  LooseClosure(const Mechanism& mechanism, const Elimination& elimination,
               const LooseSheet<double>& sheet)
      : closure_(mechanism, elimination), sheet_(sheet) {}

  void restart(int lane) { closure_.restart(lane); }
  double linearize(const SheetGeometry<double>&, const FoldState<double>& state) {
    return closure_.linearize(sheet_, state);
  }
  void solve(double is_free, double* x, double* null) { closure_.solve(is_free, x, null); }
  double orientation() const { return closure_.orientation(); }

 private:
  SparseClosure<double> closure_;
  const LooseSheet<double>& sheet_;
};

class LooseEquations {
 public:
  /// Both must outlive this object.
  LooseEquations(const Mechanism& mechanism, const LooseSheet<double>& sheet)
      : system_(mechanism), sheet_(sheet) {}

  double evaluate(const SheetGeometry<double>&, const FoldState<double>& state) {
    return system_.evaluate(sheet_, state);
  }
  const Eigen::VectorXd& residual() const { return system_.residual(); }
  const Eigen::MatrixXd& jacobian() const { return system_.jacobian(); }

 private:
  ClosureSystem system_;
  const LooseSheet<double>& sheet_;
};

}  // namespace misalign::solver
