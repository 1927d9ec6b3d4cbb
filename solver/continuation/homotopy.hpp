// A homotopy in the shifts (Allgower & Georg, Introduction to Numerical Continuation Methods, ch.
// 1), for a sheet too far from the base for Newton's method: from the base sheet to the sheet
// itself, the shifts growing from nothing to all of themselves, the pilot held at the first
// station. It is a path like any other, whose pilot is the share of the shifts.
#pragma once

#include "solver/continuation/path_follower.hpp"
#include "solver/linear/dense_closure.hpp"

namespace misalign::solver {

/// Loop closure of the sheet with a share of its shifts, for a DenseClosure. The pilot crease of a
/// state stands for the share: half_sine / that of the first station. The joint itself is held
/// there.
class GrowingShifts {
 public:
  /// All must outlive this object.
  GrowingShifts(const Mechanism& mechanism, const HalfAngle<double>& pilot,
                const FlatVertices& base_vertices_mm);

  /// The sheet whose shifts grow.
  void begin(const FlatVertices& vertices_mm) { shifts_mm_ = vertices_mm - base_vertices_mm_; }

  double evaluate(const SheetGeometry<double>&, const FoldState<double>& state);
  const Eigen::VectorXd& residual() const { return system_.residual(); }
  /// equations x unknowns; the last column by the angle that stands for the share.
  const Eigen::MatrixXd& jacobian() const { return jacobian_; }

 private:
  void place_at(double share);

  const Mechanism& mechanism_;
  const HalfAngle<double> pilot_;
  const FlatVertices& base_vertices_mm_;
  ClosureSystem system_;
  FlatVertices shifts_mm_, vertices_mm_;
  SheetGeometry<double> geometry_;
  FoldState<double> state_;
  std::vector<double> before_, after_;
  Eigen::MatrixXd jacobian_;
};

class ShiftHomotopy {
 public:
  /// All must outlive this object. `base_vertices_mm` are those of the unshifted sheet.
  ShiftHomotopy(const Mechanism& mechanism, const PathPlan& plan,
                const FlatVertices& base_vertices_mm);

  /// Follows the branch to the sheet with these vertices. end_reached: state() is the path's own
  /// state at the first station. fold_limit: the branch of the base folding turns before the shifts
  /// are whole, so this sheet has no such folding next to flat. Otherwise neither was found: a
  /// numerical failure.
  PathEnd find(const FlatVertices& vertices_mm);
  const FoldState<double>& state() const { return state_; }

 private:
  const Mechanism& mechanism_;
  const PathPlan& path_;
  GrowingShifts equations_;
  const PathPlan shares_;
  PathFollower<double, CloseSteps, DenseClosure<GrowingShifts>> follower_;
  SheetGeometry<double> base_geometry_;
  FoldState<double> state_;
};

}  // namespace misalign::solver
