// What sheets next to one are like, to first order in how their vertices are shifted.
#pragma once

#include <optional>
#include <vector>

#include "solver/design/optimise.hpp"
#include "solver/linear/simplex.hpp"

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

/// The largest goal of the model within a box. Columns: what each coordinate rises and what each
/// falls, in boxes, and what the goal rises, in units. Rows: those of the model that the box
/// reaches, the goals, the box.
struct LocalProgram {
  std::vector<const LocalRow*> reached;
  LinearProgram linear;
  Eigen::VectorXd scales;  ///< what 1 of each row's bound is: mm, or as the row's slack
  double box_mm, unit;     ///< the unit of the goal: N mm per mm

  /// By what the goal grows for each 1 that a row has more: N mm per mm.
  double price(const LinearOptimum& best, Eigen::Index row) const {
    return unit * best.price(row) / scales(row);
  }
  Eigen::VectorXd change_mm(const LinearOptimum& best) const;
};

/// No coordinate changes by more than `box_mm`, nor rises or falls by more than there is room for.
/// `model` must outlive the program.
LocalProgram local_program(const LocalModel& model, double box_mm, const Eigen::ArrayXd& rise_mm,
                           const Eigen::ArrayXd& fall_mm);

/// Around a sheet that fits; `options.deploying` says from where it is let go. None where its
/// gradients are not found.
std::optional<LocalModel> local_model(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
