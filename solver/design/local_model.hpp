// What sheets next to one are like, to first order in how their vertices are shifted.
#pragma once

#include <optional>
#include <vector>

#include "solver/design/optimise.hpp"
#include "solver/linear/simplex.hpp"

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

/// The largest goal of the model within a box. Columns: what each coordinate rises and what each
/// falls, in boxes, and what the goal rises, in units. Rows: those of the model that the box
/// reaches, the goals, the box.
struct LocalProgram {
  std::vector<const LocalRow*> reached;
  LinearProgram linear;
  Eigen::VectorXd scales;  ///< what 1 of each row's bound is: mm, or as the row's slack
  double box_mm, unit;     ///< the unit of the goal

  /// By what the goal grows for each 1 that a row has more.
  double price(const LinearOptimum& best, Eigen::Index row) const {
    return unit * best.price(row) / scales(row);
  }
  Eigen::VectorXd change_mm(const LinearOptimum& best) const;
};

/// No coordinate changes by more than `box_mm`. `model` must outlive the program.
LocalProgram local_program(const LocalModel& model, double box_mm);

/// Around a sheet that fits; `options.deploying` says from where it is let go. None where its
/// gradients are not found.
std::optional<LocalModel> local_model(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
