#include "solver/optimise/local_program.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd LocalProgram::change_mm(const LinearOptimum& best) const {
  const Index count = (linear.gain.size() - 1) / 2;
  assert(best.x.size() >= 2 * count);
  return box_mm * (best.x.head(count) - best.x.segment(count, count));
}

// Entries are about 1, for the simplex method.
LocalProgram local_program(const LocalModel& model, double box_mm) {
  const Index count = model.coordinates, goals = std::ssize(model.goals);
  assert(box_mm > 0 && goals > 0);
  assert(model.rise_mm.size() == count && model.fall_mm.size() == count);
  const double goal = model.goal(VectorXd::Zero(count));
  LocalProgram program{{}, {}, {}, box_mm, 0};
  for (const LocalModel::Row& constraint : model.rows) {
    const double reach = box_mm * constraint.row.lpNorm<1>();
    if (reach > 0 && constraint.slack < reach) program.reached.push_back(&constraint);
  }
  for (const GoalTerm& term : model.goals) {
    program.unit =
        std::max(program.unit, box_mm * term.row.lpNorm<Eigen::Infinity>() / term.divisor);
  }
  if (program.unit == 0) program.unit = 1;  // nothing changes it
  const Index rows = std::ssize(program.reached);
  LinearProgram& linear = program.linear;
  linear.rows.setZero(rows + goals + 2 * count, 2 * count + 1);
  linear.bounds.resize(linear.rows.rows());
  linear.gain = VectorXd::Unit(2 * count + 1, 2 * count);
  program.scales = VectorXd::Constant(linear.rows.rows(), box_mm);
  for (Index k = 0; k < rows; ++k) {
    const LocalModel::Row& constraint = *program.reached[static_cast<std::size_t>(k)];
    const double largest = constraint.row.lpNorm<Eigen::Infinity>();
    program.scales(k) *= largest;
    linear.rows.row(k).head(count) = -constraint.row / largest;
    linear.rows.row(k).segment(count, count) = constraint.row / largest;
    // A violated row may not get worse.
    linear.bounds(k) = std::max(constraint.slack, 0.0) / program.scales(k);
  }
  for (Index k = 0; k < goals; ++k) {
    const GoalTerm& term = model.goals[static_cast<std::size_t>(k)];
    const VectorXd gain = box_mm * term.row / (term.divisor * program.unit);
    linear.rows.row(rows + k) << -gain.transpose(), gain.transpose(), 1;
    linear.bounds(rows + k) = std::max(0.0, (term.numerator / term.divisor - goal) / program.unit);
  }
  linear.rows.bottomLeftCorner(2 * count, 2 * count).setIdentity();
  linear.bounds.tail(2 * count) << (model.rise_mm / box_mm).min(1).max(0),
      (model.fall_mm / box_mm).min(1).max(0);
  assert(linear.bounds.minCoeff() >= 0 && "to change nothing is feasible");
  return program;
}

}  // namespace misalign::solver
