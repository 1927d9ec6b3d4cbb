// The frozen reference: the paper's method on dense matrices, every sample from the one before,
// ending at the first fault. Later solvers are measured, in speed and in verdicts, against this
// one.
#pragma once

#include <vector>

#include "solver/verdict/history.hpp"

namespace misalign::solver {

class Reference {
 public:
  /// Both must outlive this object, which allocates nothing once it has judged a sheet.
  Reference(const Mechanism& mechanism, const PathPlan& plan);

  Verdict judge(const FlatVertices& vertices_mm);

  /// Effort of the last judgement.
  const PathResult& path() const { return path_; }

 private:
  const Mechanism& mechanism_;
  const PathPlan& plan_;
  PathTracker tracker_;
  Judge judge_;
  SheetGeometry<double> geometry_;
  std::vector<double> lengths_;
  PathResult path_{};
};

}  // namespace misalign::solver
