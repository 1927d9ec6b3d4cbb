// A hole's rubber plate against deformation gradients of parallelograms, minimisations and
// differences.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "solver/fill/hole_energy.hpp"

namespace misalign::solver {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Corners = Eigen::Matrix<double, 2, 4>;

constexpr unsigned kSeed = 57;
constexpr double kShear = 0.5;  // N/mm

HoleShape shape_of(const Corners& at_mm) {
  const Vector2d first = at_mm.col(2) - at_mm.col(0), second = at_mm.col(3) - at_mm.col(1);
  return {first.squaredNorm(), second.squaredNorm(), first.dot(second)};
}

HoleEnergy energy_of(const Corners& rest_mm, const Corners& now_mm) {
  const HoleShape now = shape_of(now_mm);
  return PlateLaw(kShear, shape_of(rest_mm))
      .at({std::sqrt(now.first_mm2), std::sqrt(now.second_mm2)}, now.product_mm2);
}

Corners parallelogram() {
  Corners at_mm;
  at_mm << 3, 83, 121, 41, -2, 5, 84, 77;
  return at_mm;
}

double area_mm2(const Corners& at_mm) {
  double twice = 0;
  for (int k = 0; k < 4; ++k) {
    const Vector2d a = at_mm.col(k), b = at_mm.col((k + 1) % 4);
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

Matrix2d turn(double rad) { return Eigen::Rotation2Dd(rad).toRotationMatrix(); }

// A deformation with these principal stretches, in any directions.
Matrix2d gradient(double largest, double least, std::mt19937& random) {
  std::uniform_real_distribution<double> angle(0, 6.28);
  return turn(angle(random)) * Vector2d(largest, least).asDiagonal() * turn(angle(random));
}

double tense_density(double one, double other) {
  const double through = 1 / (one * other);
  return one * one + other * other + through * through - 3;
}

// The least energy of a membrane that may wrinkle: over all C + L L^T, by descent along the entries
// of L with steps that halve. What is minimised is the energy of a plate that is tense.
double least_density(const Matrix2d& c) {
  const auto at = [&](const Eigen::Vector3d& l) {
    Matrix2d lower;
    lower << l(0), 0, l(1), l(2);
    const Matrix2d more = c + lower * lower.transpose();
    return more.trace() + 1 / more.determinant() - 3;
  };
  Eigen::Vector3d l(0.3, 0.1, 0.3);
  double best = at(l), step = 0.2;
  while (step > 1e-9) {
    bool is_better = false;
    for (int k = 0; k < 13; ++k) {  // directions of a cube's faces, edges and corners
      constexpr int kWays[13][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1}, {1, 1, 0},  {1, -1, 0},
                                    {1, 0, 1},  {1, 0, -1}, {0, 1, 1}, {0, 1, -1}, {1, 1, 1},
                                    {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
      for (const double sign : {1.0, -1.0}) {
        const Eigen::Vector3d way(kWays[k][0], kWays[k][1], kWays[k][2]);
        const Eigen::Vector3d there = l + sign * step * way;
        if (const double value = at(there); value < best) best = value, l = there, is_better = true;
      }
    }
    if (!is_better) step /= 2;
  }
  return best;
}

// Stretches well inside the three states, and on both sides of their borders.
struct State {
  double largest, least;
  Tension tension;
};
constexpr State kStates[] = {
    {1.3, 1.1, Tension::both},       {1.2, 1.2, Tension::both},     {1.5, 0.82, Tension::both},
    {1.5, 0.81, Tension::wrinkled},  {1.2, 0.6, Tension::wrinkled}, {1.01, 0.99, Tension::wrinkled},
    {1.002, 0.9, Tension::wrinkled}, {0.998, 0.9, Tension::slack},  {0.8, 0.8, Tension::slack}};

TEST(PlateLaw, IsTheMembranesOfAParallelogram) {
  std::mt19937 random(kSeed);
  const Corners rest_mm = parallelogram();
  for (const State& state : kStates) {
    const Corners now_mm = gradient(state.largest, state.least, random) * rest_mm;
    const auto stretches = PlateLaw(kShear, shape_of(rest_mm)).stretches(shape_of(now_mm));
    EXPECT_NEAR(stretches.largest, state.largest, 1e-12);
    EXPECT_NEAR(stretches.least, state.least, 1e-12);
    EXPECT_EQ(stretches.tension, state.tension) << state.largest << " " << state.least;
    if (state.tension != Tension::both) continue;
    const double energy =
        kShear / 2 * area_mm2(rest_mm) * tense_density(state.largest, state.least);
    EXPECT_NEAR(energy_of(rest_mm, now_mm).n_mm, energy, 1e-10 * energy);
  }
}

TEST(PlateLaw, HasTheLeastEnergyOfAllWrinkles) {
  std::mt19937 random(kSeed);
  const Corners rest_mm = parallelogram();
  for (const State& state : kStates) {
    const Matrix2d f = gradient(state.largest, state.least, random);
    const double least = kShear / 2 * area_mm2(rest_mm) * least_density(f.transpose() * f);
    // The descent ends 1e-9 away, where the energy is flat; where nothing is to be gained it
    // approaches L = 0 as its square.
    EXPECT_NEAR(energy_of(rest_mm, f * rest_mm).n_mm, least, 1e-7) << state.largest;
  }
}

HoleEnergy at(const PlateLaw& law, const Eigen::Vector3d& by) {
  return law.at(by.head<2>(), by(2));
}

TEST(PlateLaw, ForcesAndStiffnessAreDerivatives) {
  std::mt19937 random(kSeed);
  const Corners rest_mm = parallelogram();
  const PlateLaw law(kShear, shape_of(rest_mm));
  for (const State& state : kStates) {
    const HoleShape now = shape_of(gradient(state.largest, state.least, random) * rest_mm);
    const Eigen::Vector3d here(std::sqrt(now.first_mm2), std::sqrt(now.second_mm2),
                               now.product_mm2);
    const HoleEnergy energy = at(law, here);
    const Eigen::Vector3d slopes(energy.force_n(0), energy.force_n(1), energy.across_n_per_mm);
    for (int k = 0; k < 3; ++k) {
      // All steps stay in the state of `here`: 0.01 of stretch is 0.8 mm. Differences are off by
      // h^2 of energies of some 1e3 N mm that vary over 10 mm.
      const double h = k == 2 ? 1 : 0.01;
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
      const HoleEnergy before = at(law, here - step), after = at(law, here + step);
      EXPECT_NEAR(slopes(k), (after.n_mm - before.n_mm) / (2 * h), 1e-5 * (1 + slopes.norm()))
          << k << ": " << state.largest << " " << state.least;
      if (k == 2) continue;
      const Vector2d rates = (after.force_n - before.force_n) / (2 * h);
      EXPECT_LT((energy.n_per_mm.col(k) - rates).norm(), 1e-4 * (1 + rates.norm()))
          << k << ": " << state.largest << " " << state.least;
    }
  }
}

// Only the stiffness jumps from one state to another.
TEST(PlateLaw, ForcesAreContinuousBetweenItsStates) {
  std::mt19937 random(kSeed);
  const Corners rest_mm = parallelogram();
  for (const auto& [largest, least] : {std::pair(1.5, 1 / std::sqrt(1.5)), {1.0, 0.9}}) {
    const Matrix2d left = turn(0.3), right = turn(1.1);
    const auto beside = [&](double by) {
      return energy_of(rest_mm,
                       left * Vector2d(largest + by, least + by).asDiagonal() * right * rest_mm);
    };
    const HoleEnergy below = beside(-1e-9), above = beside(1e-9);
    EXPECT_NEAR(below.n_mm, above.n_mm, 1e-4);  // 2e-9 of stretch, 80 mm, some 100 N
    EXPECT_LT((below.force_n - above.force_n).norm(), 1e-5);
    EXPECT_GT((below.n_per_mm - above.n_per_mm).norm(), 0.01);
  }
}

// The energy near the rest is that of Hooke's law: G t A0 times e1^2 + e2^2 + (e1 + e2)^2 where it
// is tense, 3/2 G t A0 e1^2 where it wrinkles. Principal stretches from I1 and J^2 would lose half
// of all digits.
TEST(PlateLaw, KeepsItsDigitsNearTheRest) {
  const Corners rest_mm = parallelogram();
  const double factor = kShear * area_mm2(rest_mm);
  for (const double strain : {1e-3, 1e-5, 1e-7}) {
    const auto stretched = [&](double one, double other) {
      return energy_of(rest_mm, turn(0.3) *
                                    Vector2d(1 + one * strain, 1 + other * strain).asDiagonal() *
                                    turn(1.1) * rest_mm)
          .n_mm;
    };
    const double unit = factor * strain * strain;
    // Terms of third order; and 1e-16 of lengths.
    const double tolerance = 10 * strain + 1e-14 / strain;
    EXPECT_NEAR(stretched(1, -1) / unit, 1.5, tolerance) << strain;
    EXPECT_NEAR(stretched(1, -0.6) / unit, 1.5, tolerance) << strain;
    EXPECT_NEAR(stretched(1, 0.5) / unit, 1 + 0.25 + 2.25, tolerance) << strain;
    EXPECT_EQ(stretched(-1, -1), 0) << strain;
  }
}

TEST(PlateLaw, DependsOnNoFrameAndNoNames) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> shift(-9, 9);
  for (const State& state : kStates) {
    Corners rest_mm = parallelogram();
    for (double& x : rest_mm.reshaped()) x += shift(random);  // no parallelogram any more
    const Corners now_mm = gradient(state.largest, state.least, random) * rest_mm;
    const HoleEnergy energy = energy_of(rest_mm, now_mm);
    const double rounding = 1e-11 * (1 + energy.n_mm);
    EXPECT_NEAR(energy_of(turn(0.7) * rest_mm, turn(-2) * now_mm).n_mm, energy.n_mm, rounding);
    // Corners named from the next one on: the diagonals change places, and one its direction.
    const std::array<int, 4> next = {1, 2, 3, 0};
    const HoleEnergy other = energy_of(rest_mm(Eigen::all, next), now_mm(Eigen::all, next));
    EXPECT_NEAR(other.n_mm, energy.n_mm, rounding);
    EXPECT_LT((other.force_n - energy.force_n.reverse()).norm(), rounding);
    EXPECT_NEAR(other.across_n_per_mm, -energy.across_n_per_mm, rounding);
  }
}

}  // namespace
}  // namespace misalign::solver
