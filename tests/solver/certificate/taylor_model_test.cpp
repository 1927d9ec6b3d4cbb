// Taylor models against MPFI, and the prover's half angles against MPFR. The long form, of ten
// million operations, is bench/model_arithmetic.cpp (results/certificates/arithmetic.md).
#include "solver/certificate/taylor_model.hpp"

#include <gtest/gtest.h>

#include "solver/certificate/interval_chart.hpp"
#include "tests/solver/model_trials.hpp"

namespace misalign::solver {
namespace {

TEST(TaylorModel, holds_every_function_that_it_stands_for) {
  constexpr std::uint64_t kSeed = 20261123;
  ModelTrials trials(kSeed);
  for (int k = 0; k < 4000; ++k) trials.run();
  for (const TrialCount& count : trials.counts()) {
    EXPECT_EQ(count.broken, 0) << count.name << ", seed " << kSeed;
    EXPECT_LT(count.silent, count.trials / 2) << count.name;
  }
}

// The same trials with radii a little too small: they must see it in every operation that rounds or
// leaves something out.
TEST(TaylorModel, would_be_seen_to_break) {
  ModelTrials trials(1, 0.9);
  for (int k = 0; k < 4000; ++k) trials.run();
  for (const TrialCount& count : trials.counts()) {
    EXPECT_GT(count.broken, 0) << count.name;
  }
}

TEST(TaylorModel, says_nothing_where_it_cannot) {
  EXPECT_FALSE(std::isfinite(reciprocal(Ball::number(1, 1)).radius));
  EXPECT_FALSE(std::isfinite(reciprocal(Ball(0.0)).radius));
  EXPECT_FALSE(std::isfinite(square_root(Ball::number(1, 1)).radius));
  EXPECT_FALSE(std::isfinite(square_root(Ball(-1.0)).radius));
  const Ball infinite = Ball::number(0, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(std::isfinite((infinite * Ball(0.0)).radius));
  EXPECT_FALSE(std::isfinite((Ball(0x1p1023) + Ball(0x1p1023)).radius));
}

// cos and sin of half an angle in degrees, as balls of MPFI.
void half_angle(double angle_deg, Enclosed& c, Enclosed& s) {
  Enclosed pi;
  mpfi_const_pi(pi.get());
  const Enclosed x = Enclosed(angle_deg) * pi / Enclosed(360);
  mpfi_cos(c.get(), x.get());
  mpfi_sin(s.get(), x.get());
}

TEST(HalfAngleBall, holds_sine_and_cosine) {
  std::mt19937_64 random(5);
  std::vector<double> angles_deg{0, 180, -180, 360, -360, 90, 1e-300, 0x1p-1074, 1e-4, 179.9999};
  for (int k = 0; k < 2000; ++k) {
    angles_deg.push_back(std::uniform_real_distribution<double>(-360, 360)(random));
    angles_deg.push_back(std::ldexp(angles_deg.back(), -static_cast<int>(random() % 300)));
  }
  // 18 steps of the series, each of them rounding by 2 u of numbers up to pi^2 / 2 and more than
  // halving what the one before left, and the angle itself.
  constexpr double kLargestRadius = 200 * kUnit;
  for (const double angle_deg : angles_deg) {
    const HalfAngle<Ball> ball = half_angle_ball(angle_deg);
    Enclosed c, s;
    half_angle(angle_deg, c, s);
    EXPECT_FALSE((Enclosed(ball.c.c[0]) - c).is_larger_than(ball.c.radius)) << angle_deg;
    EXPECT_FALSE((Enclosed(ball.s.c[0]) - s).is_larger_than(ball.s.radius)) << angle_deg;
    EXPECT_LT(ball.c.radius, kLargestRadius) << angle_deg;
    EXPECT_LT(ball.s.radius, kLargestRadius) << angle_deg;
  }
}

}  // namespace
}  // namespace misalign::solver
