// What sheets next to one are like, to first order in how their vertices are shifted.
#pragma once

#include <optional>
#include <vector>

#include "solver/design/optimise.hpp"

namespace misalign::solver {

/// Of one inequality: slack + row . (change of the coordinates) >= 0. Coordinates: x and y of each
/// vertex that may be shifted, in turn; or what the moves of the options are taken by.
struct LocalRow {
  enum class Of { direction, stroke, force, fold_limit, fold_angle, amplitude, floor } of;
  int where;         ///< diagonal, crease, coordinate of a shift, or floor
  double pilot_deg;  ///< where on the way
  double slack;
  Eigen::VectorXd row;
};

/// The goal is the least of all: energy between two angles over what the creases turn between
/// them, N mm and mm; or how far a diagonal goes on over how fast that changes, mm and mm per mm.
struct LocalGoal {
  double amount, over;
  Eigen::VectorXd row;  ///< of the amount, per mm
};

struct LocalModel {
  std::vector<LocalRow> rows;
  std::vector<LocalGoal> goals;
  Eigen::Index coordinates = 0;
  /// How far each may rise, and fall; where they move together, rows say it.
  Eigen::ArrayXd rise_mm, fall_mm;

  /// After this change.
  double goal(const Eigen::VectorXd& change_mm) const;
};

/// Around a sheet that fits; `options.deploying` says from where it is let go. None where its
/// gradients are not found.
std::optional<LocalModel> local_model(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
