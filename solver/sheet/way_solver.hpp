// Finds folding ways: outlines a path in long steps, then solves it at equidistant x.
#pragma once

#include <optional>

#include "solver/continuation/path_follower.hpp"
#include "solver/sheet/folding_way.hpp"

namespace misalign::solver {

/// Where one sheet's path ends, and a state of it near flat.
struct PathOutline {
  PathResult path;
  FoldState<double> near;
  double near_deg;  ///< its pilot; 0: there is none, the path is lost

  bool has_near() const { return near_deg > 0; }
};

/// Of the path to the end of the model's as a function, or where that is lost in close steps.
PathOutline outline_path(const Model& model, const FlatVertices& vertices_mm,
                         PathFollower<double, LongSteps>& follower,
                         PathFollower<double>& close_follower);

/// Nothing where the path is lost, a numerical failure. Where it is lost only behind half of the
/// stations it ends at the last one that was solved.
std::optional<FoldingWay> solve_way(const Model& model, const FlatVertices& vertices_mm,
                                    const PathOutline& outline, int station_count,
                                    PathFollower<double>& close_follower);

/// Of a sheet that folds by its base's own fold angles, to the end of the model's path.
FoldingWay way_on_base(const Model& model, const FlatVertices& vertices_mm, int station_count);

}  // namespace misalign::solver
