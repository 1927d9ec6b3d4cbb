// The path of a sheet that folds by its base's own fold angles, in closed form: nothing is solved.
// Sheets of the parallel family do (solver/pattern/README.md), with however few holes.
#pragma once

#include <memory>
#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

class BasePath {
 public:
  /// Both must outlive this object. The base folds flat, and tangents of half its fold angles are
  /// in proportion, as those of every base that has a parallel family.
  BasePath(const Mechanism& mechanism, const PerforatedSheet& base);
  ~BasePath();

  /// State, rates by radian of pilot, lengths and slopes where the pilot is folded so far; `misfit`
  /// is what these rates open.
  void find(const SheetGeometry<double>& geometry, const HalfAngle<double>& pilot,
            PathPoint& point) const;
  void find_state(const HalfAngle<double>& pilot, FoldState<double>& state) const;
  void find_rates(const HalfAngle<double>& pilot, std::vector<double>& rates) const;

  /// How far the worst of all loops is open there (rad, panel widths): of a member rounding alone,
  /// also of the equations that are more than it has unknowns.
  double open_by(const SheetGeometry<double>& geometry, const FoldState<double>& state);
  /// The least of the Jacobian's without the pilot's column, at the state of open_by: where it is
  /// not zero, the sheet folds in this one way. 0 below some 1e-8, which cannot be told from that.
  double singular_value();

 private:
  struct Equations;

  const Mechanism& mechanism_;
  const PerforatedSheet& base_;
  std::vector<double> tangents_;  // of half the fold angle, per edge, over the pilot's
  std::unique_ptr<Equations> equations_;
};

}  // namespace misalign::solver
