// The frozen reference: the paper's method on dense matrices, every sample from the one before,
// ending at the first fault. Later solvers are measured, in speed and in verdicts, against this
// one.
#pragma once

#include <vector>

#include "solver/reference/path_tracker.hpp"
#include "solver/verdict/dense_state.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

class Reference {
 public:
  /// Both must outlive this object, which allocates nothing once it has judged a sheet.
  /// `bumps`: see reference.cpp.
  Reference(const Mechanism& mechanism, const PathPlan& plan, BumpRule bumps = BumpRule::ignored);

  Verdict judge(const FlatVertices& vertices_mm);

  /// Effort of the last judgement.
  const PathResult& path() const { return path_; }

 private:
  const Mechanism& mechanism_;
  const PathPlan& plan_;
  PathTracker tracker_;
  const BumpRule bumps_;
  Judge judge_;
  SheetGeometry<double> geometry_;
  DenseState dense_state_;  // for slopes, which bumps are seen by
  PathPoint point_;
  PathResult path_{};
};

}  // namespace misalign::solver
