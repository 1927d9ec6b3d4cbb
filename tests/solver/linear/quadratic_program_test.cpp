#include "solver/linear/quadratic_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace misalign::solver {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

QuadraticProgram drawn(std::mt19937& random, Eigen::Index count, Eigen::Index rows) {
  std::normal_distribution<double> normal;
  const auto matrix = [&](Eigen::Index r, Eigen::Index c) {
    return MatrixXd(MatrixXd::NullaryExpr(r, c, [&] { return normal(random); }));
  };
  const MatrixXd half = matrix(count / 2 + 1, count);  // not of full rank
  QuadraticProgram program;
  program.hessian = half.transpose() * half;
  program.gradient = matrix(count, 1);
  program.rows = matrix(rows, count);
  program.slacks = matrix(rows, 1);
  program.fall = ArrayXd::Constant(count, 0.7);
  program.rise = ArrayXd::Constant(count, 1.1);
  program.fall(0) = 0;
  program.penalty = 2;
  return program;
}

double value_of(const QuadraticProgram& program, const VectorXd& x) {
  return x.dot(program.hessian * x) / 2 + program.gradient.dot(x) +
         program.penalty * (-(program.slacks + program.rows * x).array()).max(0).sum();
}

// A convex function is nowhere lower if no point nearby is.
TEST(QuadraticProgram, HasNoLowerPointNearby) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 40; ++trial) {
    const QuadraticProgram program = drawn(random, 3 + trial % 8, trial % 13);
    const QuadraticOptimum best = minimize(program);
    ASSERT_TRUE(best.is_found) << trial;
    EXPECT_NEAR(best.value, value_of(program, best.x), 1e-12);
    EXPECT_GE((best.x.array() + program.fall).minCoeff(), 0);
    EXPECT_GE((program.rise - best.x.array()).minCoeff(), 0);
    for (int k = 0; k < 2000; ++k) {
      const double reach = std::pow(10.0, -k % 6);
      const VectorXd other =
          (best.x + reach * VectorXd::NullaryExpr(best.x.size(), [&] { return normal(random); }))
              .array()
              .max(-program.fall)
              .min(program.rise);
      EXPECT_GE(value_of(program, other), best.value - 1e-7) << trial;
    }
  }
}

// Prices are derivatives of the value by the slacks, where no constraint changes sides.
TEST(QuadraticProgram, PricesARow) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 10; ++trial) {
    QuadraticProgram program = drawn(random, 6, 5);
    const QuadraticOptimum best = minimize(program);
    for (Eigen::Index k = 0; k < 5; ++k) {
      constexpr double kStep = 1e-3;
      QuadraticProgram up = program, down = program;
      up.slacks(k) += kStep;
      down.slacks(k) -= kStep;
      const double fall = (minimize(down).value - minimize(up).value) / (2 * kStep);
      EXPECT_NEAR(best.price(k), fall, 0.02);
    }
  }
}

// min (x - 2)^2 / 2 within 1, and with a row x <= 0.5 that costs less than it holds: 1 - x = 0.4.
TEST(QuadraticProgram, SolvesHandCases) {
  QuadraticProgram program{MatrixXd::Ones(1, 1),
                           VectorXd::Constant(1, -2),
                           MatrixXd(0, 1),
                           VectorXd(0),
                           ArrayXd::Ones(1),
                           ArrayXd::Ones(1),
                           1};
  EXPECT_NEAR(minimize(program).x(0), 1, 1e-7);
  program.gradient(0) = -1;
  program.rows = MatrixXd::Constant(1, 1, -1);
  program.slacks = VectorXd::Constant(1, 0.5);
  program.penalty = 0.4;
  const QuadraticOptimum best = minimize(program);
  EXPECT_NEAR(best.x(0), 0.6, 1e-7) << "violated at the price of 0.4";
  EXPECT_NEAR(best.price(0), 0.4, 1e-7);
}

}  // namespace
}  // namespace misalign::solver
