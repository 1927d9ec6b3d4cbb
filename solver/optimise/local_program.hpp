// The best change of a sheet within a box, to first order, as a linear program.
#pragma once

#include <vector>

#include "solver/linear/simplex.hpp"
#include "solver/optimise/local_model.hpp"

namespace misalign::solver {

/// The largest goal of the model within a box. Columns: what each coordinate rises and what each
/// falls, in boxes, and what the goal rises, in units. Rows: those of the model that the box
/// reaches, the goals, the box.
struct LocalProgram {
  std::vector<const LocalModel::Row*> reached;
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

}  // namespace misalign::solver
