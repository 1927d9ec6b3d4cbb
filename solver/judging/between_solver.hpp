// Solves single states of a path in close steps, each between two known ones.
#pragma once

#include <memory>

#include "solver/continuation/path.hpp"
#include "solver/linear/elimination.hpp"

namespace misalign::solver {

/// A known state of a path with its rates, and the pilot's fold angle there.
struct SolvedPlace {
  double pilot_rad;
  const PathPoint& point;
};

class BetweenSolver {
 public:
  /// Both must outlive this object, which makes its workspace when it is first needed.
  BetweenSolver(const Mechanism& mechanism, const Elimination& elimination);
  ~BetweenSolver();

  /// Makes the workspace now: `solve` then allocates nothing but factors with pivoting, if needed.
  void prepare();
  /// Solves a state between two places of one sheet. Returns false if none is found near them.
  bool solve(const SheetGeometry<double>& geometry, const SolvedPlace& from, const SolvedPlace& to,
             double pilot_rad, PathPoint& point);

 private:
  struct Workspace;

  const Mechanism& mechanism_;
  const Elimination& elimination_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace misalign::solver
