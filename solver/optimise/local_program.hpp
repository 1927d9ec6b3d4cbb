// Finds the best change of a sheet within a box, to first order, as a linear program.
#pragma once

#include <vector>

#include "solver/linear/simplex.hpp"
#include "solver/optimise/local_model.hpp"

namespace misalign::solver {

/// Maximises the goal of the model within a box. Columns: each coordinate's rise and fall, in
/// boxes, and the goal's rise, in units. Rows: those of the model that the box reaches, the goals,
/// the box.
struct LocalProgram {
  std::vector<const LocalModel::Row*> reached;
  LinearProgram linear;
  Eigen::VectorXd scales;  ///< unit of each row's bound: mm, or that of its slack
  double box_mm, unit;     ///< the unit of the goal

  /// Price of a row: the goal's growth per unit of its slack.
  double price(const LinearOptimum& best, Eigen::Index row) const {
    return unit * best.price(row) / scales(row);
  }
  Eigen::VectorXd change_mm(const LinearOptimum& best) const;
};

/// No coordinate changes by more than `box_mm`. `model` must outlive the program.
LocalProgram local_program(const LocalModel& model, double box_mm);

}  // namespace misalign::solver
