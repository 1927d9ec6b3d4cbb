// The frozen reference: the paper's method on dense matrices, every sample from the one before,
// ending at the first fault. Later solvers are measured, in speed and in verdicts, against this
// one.
#pragma once

#include <vector>

#include "solver/model/pivoted_state.hpp"
#include "solver/reference/path_tracker.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// Plan of a Reference: its stations are at most a tenth of a degree apart where bumps are exact.
PathPlanOptions reference_path(PathPlanOptions path, double longest_step_deg, BumpRule bumps);

class Reference {
 public:
  /// Both must outlive this object, which allocates nothing once it has judged a sheet. Exact bumps
  /// are found by cubics between the plan's stations, which must be close.
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
  PivotedState pivoted_state_;  // for slopes, which show bumps and stops
  PathPoint point_;
  struct Visited {
    double pilot_deg;
    PathPoint point;
  };
  std::vector<Visited> visited_;  // from the last sample on, for exact bumps
  PathResult path_{};
};

}  // namespace misalign::solver
