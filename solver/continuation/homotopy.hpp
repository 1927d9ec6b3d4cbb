// A homotopy in the shifts (Allgower & Georg, Introduction to Numerical Continuation Methods, ch.
// 1), for a sheet too far from the base for Newton's method: from the base sheet to the sheet
// itself, the shifts growing from nothing to all of themselves, the pilot held at the first
// station. It is a path like any other, whose pilot is the share of the shifts.
#pragma once

#include "solver/continuation/path_follower.hpp"
#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {

/// Loop closure of the sheet with a share of its shifts, factored in the fixed order. The pilot
/// crease of a state stands for the share: half_sine / that of the first station. The joint itself
/// is held there; its column of the Jacobian is the share's, which is in every equation and so kept
/// beside the sparse factors.
class GrowingShifts {
 public:
  /// All must outlive this object.
  GrowingShifts(const Mechanism& mechanism, const Elimination& elimination,
                const HalfAngle<double>& pilot, const FlatVertices& base_vertices_mm);

  /// The sheet whose shifts grow.
  void begin(const FlatVertices& vertices_mm) { shifts_mm_ = vertices_mm - base_vertices_mm_; }

  double linearize(const FoldState<double>& state);
  void solve(double is_free, double* x, double* null);
  double orientation() const { return lu_.orientation(); }

 private:
  void place_at(double share);
  void solve_with(double of_residual, double partner, double share, double* x);

  const Mechanism& mechanism_;
  const HalfAngle<double> pilot_;
  const FlatVertices& base_vertices_mm_;
  SparseLu<double> lu_;
  FlatVertices shifts_mm_, vertices_mm_;
  SheetGeometry<double> geometry_;
  FoldState<double> state_;
  // Per equation, with room for one more: the residual and the share's column, then L y of each.
  std::vector<double> residual_, before_, after_, of_residual_, of_share_, work_;
};

/// As a PathFollower wants it, like SparseClosure.
struct ShareClosure {
  GrowingShifts* shifts;

  void restart(int) {}
  double linearize(const SheetGeometry<double>&, const FoldState<double>& state) {
    return shifts->linearize(state);
  }
  void solve(double is_free, double* x, double* null) { shifts->solve(is_free, x, null); }
  double orientation() const { return shifts->orientation(); }
};

class ShiftHomotopy {
 public:
  /// All must outlive this object. `base_vertices_mm` are those of the unshifted sheet.
  ShiftHomotopy(const Mechanism& mechanism, const Elimination& elimination, const PathPlan& plan,
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
  GrowingShifts shifts_;
  const PathPlan shares_;
  PathFollower<double, CloseSteps, ShareClosure> follower_;
  SheetGeometry<double> base_geometry_;
  FoldState<double> state_;
};

}  // namespace misalign::solver
