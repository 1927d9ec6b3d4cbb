// Where a path starts when its sheet is too far from the base for Newton's method: from the base
// sheet to the sheet itself, the shifts growing from nothing to all of themselves, the pilot held
// at the first stop (a homotopy in the shifts; Allgower & Georg, Introduction to Numerical
// Continuation Methods, ch. 1).
#pragma once

#include <Eigen/Core>
#include <memory>

#include "solver/continuation/path.hpp"
#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {

enum class StartEnd {
  found,         ///< `state` is the path's own state at the first stop
  branch_ended,  ///< the branch of the base folding turns (found by arc length) before the shifts
                 ///< are whole: this sheet has no such folding next to flat
  lost           ///< neither was found: a numerical failure
};

class StartFinder {
 public:
  /// All must outlive this object. `base_vertices_mm` are those of the unshifted sheet.
  StartFinder(const Mechanism& mechanism, const Elimination& elimination, const PathPlan& plan,
              const FlatVertices& base_vertices_mm);
  ~StartFinder();

  /// Follows the branch to the sheet with these vertices.
  StartEnd find(const FlatVertices& vertices_mm);
  const FoldState<double>& state() const { return state_; }

 private:
  double evaluate_at(double share, const FoldState<double>& state);
  bool correct(double share);
  StartEnd walk(double share);
  bool find_tangent(double share);

  const Mechanism& mechanism_;
  const PathPlan& plan_;
  const FlatVertices& base_vertices_mm_;
  SparseLu<double> lu_;
  std::vector<JacobianEntry> entries_;
  FlatVertices shifts_mm_, vertices_mm_;
  SheetGeometry<double> geometry_;
  FoldState<double> state_, trial_;
  int branch_sign_ = 0;  // of the determinant on the branch
  std::vector<double> residual_, other_residual_, values_, y_, turn_, move_, last_move_;
  // Of the walk: [J without the pilot, change with the share; tangent], dense.
  Eigen::MatrixXd bordered_;
  std::unique_ptr<DenseSolve> solve_;
  Eigen::VectorXd rhs_, step_, tangent_, last_tangent_;
};

}  // namespace misalign::solver
