// Follows the folding path of one sheet as in the paper's section 4: the pilot is held at one
// station after another, each solved from the one before, the first from the base folding.
#pragma once

#include "solver/continuation/path.hpp"
#include "solver/reference/arc_length.hpp"

namespace misalign::solver {

class PathTracker {
 public:
  explicit PathTracker(const Mechanism& mechanism);

  /// Calls `visit(station, state)` at each station to be seen, until it returns false or the path
  /// ends. Allocates nothing.
  template <class Visitor>
  PathResult follow(const SheetGeometry<double>& geometry, const PathPlan& plan, Visitor&& visit) {
    begin(plan);
    for (const Station& station : plan.stations) {
      if (!advance_to(geometry, station)) return result_;
      if (station.visit && !visit(station, static_cast<const FoldState<double>&>(state_))) {
        result_.end = PathEnd::stopped;
        return result_;
      }
    }
    result_.end = PathEnd::end_reached;
    return result_;
  }

 private:
  void begin(const PathPlan& plan);
  bool advance_to(const SheetGeometry<double>& geometry, const Station& station);
  bool step_to(const SheetGeometry<double>& geometry, const Station& station);

  Newton newton_;
  ArcLength arc_length_;
  int pilot_;
  int forward_sign_ = 0;  // sign of the Jacobian's determinant, from the first station on
  FoldState<double> state_, trial_;
  PathResult result_{};
};

}  // namespace misalign::solver
