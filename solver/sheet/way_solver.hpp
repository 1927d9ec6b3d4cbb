// Finds folding ways: outlines a path in long steps, then solves it at equidistant x.
#pragma once

#include <optional>

#include "solver/continuation/path_follower.hpp"
#include "solver/sheet/folding_way.hpp"

namespace misalign::solver {

/// End of one sheet's path, and a state near flat.
struct PathOutline {
  PathResult path;
  FoldState<double> near;
  double near_deg;  ///< pilot angle of that state; 0: none, the path is lost

  bool has_near() const { return near_deg > 0; }
};

/// Outlines the path to the end of the model's, as a function, or where that is lost in close
/// steps.
PathOutline outline_path(const Model& model, const FlatVertices& vertices_mm,
                         PathFollower<double, LongSteps>& follower,
                         PathFollower<double>& close_follower);

/// Returns nothing where the path is lost, a numerical failure. A path that is lost only behind
/// half of the stations ends at the last one that was solved.
std::optional<FoldingWay> solve_way(const Model& model, const FlatVertices& vertices_mm,
                                    const PathOutline& outline, int station_count,
                                    PathFollower<double>& close_follower);

/// Path of a sheet that folds by the fold angles of its base, to the end of the model's path.
FoldingWay way_on_base(const Model& model, const FlatVertices& vertices_mm, int station_count);

}  // namespace misalign::solver
