// A linear model of the sheets next to one: what every one keeps, and the goal.
#pragma once

#include <optional>
#include <vector>

#include "solver/optimise/local_goals.hpp"

namespace misalign::solver {

struct LocalModel {
  /// An inequality: slack + row . (change of the coordinates) >= 0.
  struct Row {
    enum class Kind { direction, stroke, force, fold_limit, fold_angle, amplitude, floor } kind;
    int where;         ///< diagonal, crease, coordinate of a shift, or floor
    double pilot_deg;  ///< where on the way
    double slack;
    Eigen::VectorXd row;
  };

  std::vector<Row> rows;
  std::vector<LocalGoal> goals;
  Eigen::Index coordinates = 0;
  /// How far each may rise, and fall; of those that are free rows say it.
  Eigen::ArrayXd rise_mm, fall_mm;

  /// After this change.
  double goal(const Eigen::VectorXd& change_mm) const;
};

/// Around a sheet that fits; `options.deploying` says from where it is let go, and has its springs.
/// None where its gradients are not found.
std::optional<LocalModel> local_model(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
