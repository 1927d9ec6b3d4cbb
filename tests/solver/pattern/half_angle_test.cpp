#include "solver/pattern/half_angle.hpp"

#include <gtest/gtest.h>

namespace misalign::solver {
namespace {

// The C library's sine and cosine are good to 1 ulp; argument rounding adds half of one.
TEST(HalfAngle, AgreesWithTheCLibrary) {
  for (double angle = -359.9; angle <= 359.9; angle += 0.37) {
    const auto half = half_angle_of_deg(angle);
    EXPECT_NEAR(half.c, std::cos(angle / 2 * kRadPerDeg), 4e-16) << angle;
    EXPECT_NEAR(half.s, std::sin(angle / 2 * kRadPerDeg), 4e-16) << angle;
    EXPECT_NEAR(angle_deg(half), angle, 1e-12);
  }
}

TEST(HalfAngle, OfRadiansAndBackAgreesWithTheCLibrary) {
  for (double angle = -6.28; angle <= 6.28; angle += 0.0037) {
    const auto half = half_angle_of_rad(angle);
    EXPECT_NEAR(half.c, std::cos(angle / 2), 3e-16) << angle;
    EXPECT_NEAR(half.s, std::sin(angle / 2), 3e-16) << angle;
    const double expected = 2 * std::atan2(half.s, half.c);
    EXPECT_NEAR(angle_rad(half), expected, 4 * 2.3e-16 * std::abs(expected)) << angle;
  }
  EXPECT_EQ(angle_rad({1, 0}), 0);
  EXPECT_EQ(angle_rad({0, 1}), kPi);
  EXPECT_EQ(angle_rad({0, -1}), -kPi);
}

// 67 angles fill no whole number of registers, however wide.
TEST(HalfAngle, AnglesOfManyAreThoseOneByOne) {
  std::vector<HalfAngle<double>> halves{{1, 0}, {0, 1}, {0, -1}, {-1, 0}};
  for (int k = 0; k < 63; ++k) halves.push_back(half_angle_of_rad(0.2 * (k - 31)));
  std::vector<double> angles_rad(halves.size());
  find_angles(halves.data(), static_cast<int>(halves.size()), angles_rad.data());
  for (std::size_t k = 0; k < halves.size(); ++k) {
    EXPECT_EQ(angles_rad[k], angle_rad(halves[k])) << k;
    const double expected = 2 * std::atan2(halves[k].s, halves[k].c);
    EXPECT_NEAR(angles_rad[k], expected, 4 * 2.3e-16 * std::abs(expected)) << k;
  }
}

TEST(HalfAngle, ExactWhereItMatters) {
  EXPECT_EQ(half_angle_of_deg(0).s, 0);
  EXPECT_EQ(half_angle_of_deg(180).c, 0);
  EXPECT_EQ(half_angle_of_deg(180).s, 1);
  EXPECT_EQ(half_angle_of_ratio(1, 0).c, 0);  // tan(rho / 2) infinite: closed
}

// Turning is right to second order: the error of the retraction is delta^3 / 12.
TEST(HalfAngle, TurnsByTheStepToSecondOrder) {
  for (const double delta_deg : {1e-3, 0.1, 1.0, 5.0}) {
    const double delta = delta_deg * kRadPerDeg;
    for (const double from : {-170.0, 0.0, 89.0, 179.9}) {
      const double turned = angle_deg(half_angle_of_deg(from).turned(delta)) * kRadPerDeg;
      EXPECT_NEAR(turned - from * kRadPerDeg, delta, delta * delta * delta / 12 * 1.01 + 1e-14);
    }
  }
}

TEST(HalfAngle, OrderIsExactNextToEquality) {
  const auto a = half_angle_of_deg(156.0), b = half_angle_of_deg(156.0 + 1e-12);
  EXPECT_GT(half_sine_between(b, a), 0);
  EXPECT_LT(half_sine_between(a, b), 0);
  EXPECT_EQ(half_sine_between(a, a), 0);
}

}  // namespace
}  // namespace misalign::solver
