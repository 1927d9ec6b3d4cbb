// The linearisation of an optimisation around one sheet: its constraints and its goal.
#pragma once

#include <optional>
#include <vector>

#include "solver/optimise/local_goals.hpp"

namespace misalign::solver {

struct LocalModel {
  /// An inequality: slack + row . (change of the coordinates) >= 0.
  struct Row {
    enum class Kind {
      direction,
      energy,
      stroke,
      force,
      fold_limit,
      fold_angle,
      amplitude,
      floor
    } kind;
    int where;         ///< diagonal, crease, coordinate of a shift, or floor
    double pilot_deg;  ///< pilot angle
    double slack;
    Eigen::VectorXd row;
  };

  std::vector<Row> rows;
  std::vector<GoalTerm> goals;
  Eigen::Index coordinates = 0;
  /// Largest rise and fall of each coordinate; rows bound the free ones.
  Eigen::ArrayXd rise_mm, fall_mm;

  /// Value of the goal after this change.
  double goal(const Eigen::VectorXd& change_mm) const;
};

/// Linearises around a feasible sheet; `options.deploying` has its angle of use and its springs.
/// None where its gradients are not found.
std::optional<LocalModel> local_model(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
