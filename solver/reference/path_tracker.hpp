// The folding path of one sheet as the paper's section 4 has it: the pilot held at one stop after
// another, each solved from the one before, the first from the base folding.
#pragma once

#include "solver/continuation/path.hpp"
#include "solver/reference/arc_length.hpp"

namespace misalign::solver {

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
