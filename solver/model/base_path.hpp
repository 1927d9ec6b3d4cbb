// Gives in closed form the path of a sheet that folds by its base's fold angles, as sheets of the
// parallel family do with any number of holes (solver/pattern/README.md).
#pragma once

#include <memory>
#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

class BasePath {
 public:
  /// Both must outlive this object. The base must be flat-foldable with proportional tangents of
  /// half fold angles, as every base of a parallel family is.
  BasePath(const Mechanism& mechanism, const PerforatedSheet& base);
  ~BasePath();

  /// Finds state, rates per radian of pilot, lengths and slopes at a pilot angle; `misfit` is the
  /// opening by these rates.
  void find(const SheetGeometry<double>& geometry, const HalfAngle<double>& pilot,
            PathPoint& point) const;
  void find_state(const HalfAngle<double>& pilot, FoldState<double>& state) const;
  void find_rates(const HalfAngle<double>& pilot, std::vector<double>& rates) const;

  /// Opening of the worst loop (rad, panel widths): only rounding for a member, redundant equations
  /// included.
  double open_by(const SheetGeometry<double>& geometry, const FoldState<double>& state);
  /// The Jacobian's least singular value without the pilot's column, at the state of open_by: if it
  /// is not zero, the sheet folds in this way only. Values below some 1e-8 count as 0.
  double singular_value();

 private:
  struct Equations;

  const Mechanism& mechanism_;
  const PerforatedSheet& base_;
  std::vector<double> tangents_;  // per edge: tangent of half the fold angle over the pilot's
  std::unique_ptr<Equations> equations_;
};

}  // namespace misalign::solver
