// The folding path of one sheet: the pilot held at one stop after another, each solved from the one
// before, the first from the base folding (the paper's section 4).
#pragma once

#include <vector>

#include "solver/reference/arc_length.hpp"

namespace misalign::solver {

/// A crease that moves over 20 degrees in one step has jumped to another branch: sin(10 degrees).
/// Unjumped 1-degree steps move a crease by 1 to 3 degrees, more only within 0.1 of a fold limit.
inline constexpr double kJumpHalfSine = 0.17364817766693033;

/// An angle at which the pilot is held.
struct Stop {
  double pilot_deg;
  HalfAngle<double> pilot;
  int sample;  ///< k when this is the k-th multiple of sample_deg, otherwise 0
  bool visit;  ///< false for a solver step in between that nobody asked to see
};

/// What all draws of a campaign share: the stops and the state that starts the first of them.
struct PathPlan {
  std::vector<Stop> stops;
  FoldState<double> start;
};

struct PathPlanOptions {
  double sample_deg = 1;
  double end_deg = 180;  ///< visited, whether it is a sample or not
  double look_deg = 0;   ///< visit multiples of this as well; 0: only the samples
  double longest_step_deg = 1;
};

PathPlan plan_path(const Mechanism& mechanism, const BaseFolding& folding,
                   const FlatVertices& base_vertices_mm, const PathPlanOptions& options);

enum class PathEnd {
  end_reached,  ///< the last stop was solved
  stopped,      ///< the visitor had seen enough
  fold_limit,   ///< the pilot turns (found by arc length) before the next stop
  start_lost,   ///< Newton found no first solution near the base folding: a numerical failure
  stalled       ///< neither Newton nor arc length found a way on: a numerical failure
};

struct PathResult {
  PathEnd end;
  double fold_limit_deg;  ///< where the pilot turned; otherwise the last stop solved
  int newton_solves, newton_iterations, arc_steps;
};

class PathTracker {
 public:
  explicit PathTracker(const Mechanism& mechanism);

  /// Calls `visit(stop, state)` at each stop to be seen, until it answers false or the path ends.
  /// Allocates nothing.
  template <class Visitor>
  PathResult follow(const SheetGeometry<double>& geometry, const PathPlan& plan, Visitor&& visit) {
    begin(plan);
    for (const Stop& stop : plan.stops) {
      if (!advance_to(geometry, stop)) return result_;
      if (stop.visit && !visit(stop, static_cast<const FoldState<double>&>(state_))) {
        result_.end = PathEnd::stopped;
        return result_;
      }
    }
    result_.end = PathEnd::end_reached;
    return result_;
  }

 private:
  void begin(const PathPlan& plan);
  bool advance_to(const SheetGeometry<double>& geometry, const Stop& stop);
  bool step_to(const SheetGeometry<double>& geometry, const Stop& stop);

  Newton newton_;
  ArcLength arc_length_;
  int pilot_;
  int forward_sign_ = 0;  // of the Jacobian's determinant, from the first stop on
  FoldState<double> state_, trial_;
  PathResult result_{};
};

}  // namespace misalign::solver
