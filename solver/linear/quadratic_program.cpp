#include "solver/linear/quadratic_program.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>

namespace misalign::solver {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 80;
// The mean product of a slack and its multiplier, by which it is left, beside the first.
constexpr double kLastGap = 1e-10;
// Share of the way to the next bound that a step takes.
constexpr double kToBound = 0.99;

// The longest step, at most 1, that keeps all of these positive.
double longest(const ArrayXd& values, const ArrayXd& steps) {
  double step = 1;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (steps(k) < 0) step = std::min(step, -kToBound * values(k) / steps(k));
  }
  return step;
}

// Number of rows that are summed at a time: Eigen splits longer sums by the processor's cache, and
// their last digits would depend on it.
constexpr Eigen::Index kRowsAtOnce = 256;

// Adds the sum of the rows' weighted squares to the lower triangle, which is all that is factored.
void add_squares(const Eigen::MatrixXd& rows, const VectorXd& weights, Eigen::MatrixXd& sum) {
  for (Eigen::Index first = 0; first < rows.rows(); first += kRowsAtOnce) {
    const Eigen::Index count = std::min(kRowsAtOnce, rows.rows() - first);
    const auto some = rows.middleRows(first, count);
    const Eigen::MatrixXd weighted = weights.segment(first, count).asDiagonal() * some;
    sum.triangularView<Eigen::Lower>() += weighted.transpose() * some;
  }
}

// A quantity that stays positive, its multiplier, and the steps of both.
struct Pair {
  ArrayXd value, price, value_step, price_step;

  double gap() const { return (value * price).sum(); }
  double longest_step() const {
    return std::min(longest(value, value_step), longest(price, price_step));
  }
  void advance(double step) {
    value += step * value_step;
    price += step * price_step;
  }
};

}  // namespace

QuadraticOptimum minimize(const QuadraticProgram& program) {
  const Eigen::Index count = program.gradient.size(), rows = program.slacks.size();
  assert(program.hessian.rows() == count && program.hessian.cols() == count);
  assert(program.rows.rows() == rows && (rows == 0 || program.rows.cols() == count));
  assert((program.fall >= 0).all() && (program.rise >= 0).all() && program.penalty > 0);
  assert((program.fall + program.rise > 0).all());
  VectorXd x = (program.rise - program.fall) / 2;
  const ArrayXd start = (program.slacks + program.rows * x).array();
  const double scale = std::max(1e-12, rows > 0 ? start.abs().maxCoeff() : 1);
  // Slacks of rows (with their violations), violations, and distances from either side of the box.
  Pair slack, over, low, high;
  over.value = (-start).max(0) + 0.1 * scale;
  slack.value = start + over.value;
  slack.price = over.price = ArrayXd::Constant(rows, program.penalty / 2);
  low.value = high.value = (program.rise + program.fall) / 2;
  const double force = std::max(1e-12, program.gradient.cwiseAbs().maxCoeff());
  low.price = high.price = ArrayXd::Constant(count, force);
  const auto gap = [&] {
    return (slack.gap() + over.gap() + low.gap() + high.gap()) /
           static_cast<double>(2 * (rows + count));
  };
  const auto value = [&] {
    const ArrayXd below = (-(program.slacks + program.rows * x).array()).max(0);
    return x.dot(program.hessian * x) / 2 + program.gradient.dot(x) + program.penalty * below.sum();
  };
  const double first_gap = gap();
  bool is_found = false;
  double center = 0.3;
  for (int k = 0; k < kMostIterations; ++k) {
    const VectorXd unbalanced = program.hessian * x + program.gradient -
                                program.rows.transpose() * slack.price.matrix() -
                                low.price.matrix() + high.price.matrix();
    is_found = gap() <= kLastGap * first_gap &&
               unbalanced.cwiseAbs().maxCoeff() <= 1e-8 * (force + program.penalty);
    if (is_found) break;
    const double to = center * gap();
    // Violations and prices of rows are eliminated, then those of the box.
    const ArrayXd over_per_price = over.value / over.price;
    const ArrayXd per_price = slack.value + slack.price * over_per_price;
    const ArrayXd weights = slack.price / per_price;
    const ArrayXd prices =
        (to - slack.value * slack.price - slack.price * (to / over.price - over.value)) / per_price;
    const ArrayXd at_low = to / low.value - low.price, at_high = to / high.value - high.price;
    Eigen::MatrixXd matrix = program.hessian;
    add_squares(program.rows, weights.matrix(), matrix);
    matrix.diagonal().array() += low.price / low.value + high.price / high.value;
    const VectorXd right = -unbalanced + program.rows.transpose() * prices.matrix() +
                           at_low.matrix() - at_high.matrix();
    const Eigen::LDLT<Eigen::MatrixXd> factors(matrix);
    if (factors.info() != Eigen::Success) break;
    const VectorXd step = factors.solve(right);
    const ArrayXd along = (program.rows * step).array();
    slack.price_step = prices - weights * along;
    over.price_step = -slack.price_step;
    over.value_step = (to + over.value * slack.price_step) / over.price - over.value;
    slack.value_step = along + over.value_step;
    low.value_step = step.array();
    low.price_step = at_low - low.price / low.value * step.array();
    high.value_step = -step.array();
    high.price_step = at_high + high.price / high.value * step.array();
    double length = 1;
    for (const Pair* pair : {&slack, &over, &low, &high}) {
      length = std::min(length, pair->longest_step());
    }
    for (Pair* pair : {&slack, &over, &low, &high}) pair->advance(length);
    x += length * step;
    center = length > 0.9 ? 0.05 : 0.4;
  }
  return {is_found, x, value(), slack.price.matrix()};
}

}  // namespace misalign::solver
