// What sheets next to one are like, to first order in how their vertices are shifted.
#pragma once

#include <optional>
#include <vector>

#include "solver/design/optimise.hpp"

namespace misalign::solver {

/// Of one inequality: slack + row . (shifts - its own) >= 0. Coordinates: x and y of each vertex
/// that may be shifted, in turn.
struct LocalRow {
  enum class Of { direction, stroke, force, fold_limit, fold_angle } of;
  int where;         ///< diagonal or crease
  double pilot_deg;  ///< where on the way
  double slack;
  Eigen::VectorXd row;
};

/// Energy between two angles over what the creases turn between them: the goal is the least of
/// all.
struct LocalGoal {
  double n_mm, turned_mm;
  Eigen::VectorXd row;  ///< N mm per mm
};

struct LocalModel {
  std::vector<LocalRow> rows;
  std::vector<LocalGoal> goals;

  /// After this change.
  double goal(const Eigen::VectorXd& change_mm) const;
};

/// Around a sheet that fits. None where its gradients are not found.
std::optional<LocalModel> local_model(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
