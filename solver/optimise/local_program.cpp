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

// Entries of about 1, as the simplex method wants them.
LocalProgram local_program(const LocalModel& model, double box_mm) {
  const Index count = model.coordinates, goals = std::ssize(model.goals);
  assert(box_mm > 0 && goals > 0);
  assert(model.rise_mm.size() == count && model.fall_mm.size() == count);
  const double goal = model.goal(VectorXd::Zero(count));
  LocalProgram program{{}, {}, {}, box_mm, 0};
  for (const LocalModel::Row& one : model.rows) {
    const double reach = box_mm * one.row.lpNorm<1>();
    if (reach > 0 && one.slack < reach) program.reached.push_back(&one);
  }
  for (const LocalGoal& one : model.goals) {
    program.unit = std::max(program.unit, box_mm * one.row.lpNorm<Eigen::Infinity>() / one.over);
  }
  if (program.unit == 0) program.unit = 1;  // nothing changes it
  const Index rows = std::ssize(program.reached);
  LinearProgram& linear = program.linear;
  linear.rows.setZero(rows + goals + 2 * count, 2 * count + 1);
  linear.bounds.resize(linear.rows.rows());
  linear.gain = VectorXd::Unit(2 * count + 1, 2 * count);
  program.scales = VectorXd::Constant(linear.rows.rows(), box_mm);
  for (Index k = 0; k < rows; ++k) {
    const LocalModel::Row& one = *program.reached[static_cast<std::size_t>(k)];
    const double largest = one.row.lpNorm<Eigen::Infinity>();
    program.scales(k) *= largest;
    linear.rows.row(k).head(count) = -one.row / largest;
    linear.rows.row(k).segment(count, count) = one.row / largest;
    // What does not fit gets no worse.
    linear.bounds(k) = std::max(one.slack, 0.0) / program.scales(k);
  }
  for (Index k = 0; k < goals; ++k) {
    const LocalGoal& one = model.goals[static_cast<std::size_t>(k)];
    const VectorXd by = box_mm * one.row / (one.over * program.unit);
    linear.rows.row(rows + k) << -by.transpose(), by.transpose(), 1;
    linear.bounds(rows + k) = std::max(0.0, (one.amount / one.over - goal) / program.unit);
  }
  linear.rows.bottomLeftCorner(2 * count, 2 * count).setIdentity();
  linear.bounds.tail(2 * count) << (model.rise_mm / box_mm).min(1).max(0),
      (model.fall_mm / box_mm).min(1).max(0);
  assert(linear.bounds.minCoeff() >= 0 && "to change nothing is feasible");
  return program;
}

}  // namespace misalign::solver
