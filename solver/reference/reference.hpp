// The frozen reference: the paper's method on dense matrices, every sample from the one before,
// ending at the first fault. Later solvers are measured, in speed and in verdicts, against this
// one.
#pragma once

#include <vector>

#include "solver/model/dense_state.hpp"
#include "solver/reference/path_tracker.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// The stations of a plan for a Reference: where it looks for bumps exactly, every tenth of a
/// degree at least.
PathPlanOptions reference_path(PathPlanOptions path, double longest_step_deg, BumpRule bumps);

class Reference {
 public:
  /// Both must outlive this object, which allocates nothing once it has judged a sheet.
  /// Bumps that are looked for exactly: by cubics between the plan's stations, which are to be
  /// visited closely.
  Reference(const Mechanism& mechanism, const PathPlan& plan, const Criterion& criterion = {});

  Verdict judge(const FlatVertices& vertices_mm);

  /// Effort of the last judgement.
  const PathResult& path() const { return path_; }

 private:
  bool see(const Station& station, const FoldState<double>& state);
  bool see_exactly(const Station& station);
  int longest_retreat() const;

  const Mechanism& mechanism_;
  const PathPlan& plan_;
  PathTracker tracker_;
  const Criterion criterion_;
  Judge judge_;
  SheetGeometry<double> geometry_;
  DenseState dense_state_;  // for slopes, which bumps and stops are seen by
  PathPoint point_;
  struct Visited {
    double pilot_deg;
    PathPoint point;
  };
  std::vector<Visited> visited_;  // from the last sample on, where bumps are looked for exactly
  PathResult path_{};
};

}  // namespace misalign::solver
