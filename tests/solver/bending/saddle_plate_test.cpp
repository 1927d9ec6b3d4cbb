// Plates bent into saddles, against closed forms and other degrees.
#include "solver/bending/saddle_plate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector2d;

constexpr double kNu = 0.33;

std::array<Vector2d, 4> rectangle(double a, double b) {
  return {Vector2d(0, 0), Vector2d(a, 0), Vector2d(a, b), Vector2d(0, b)};
}

// w = q x y / (a b): no moment, no shear force at any edge, so that nothing relaxes it.
TEST(SaddlePlate, RectanglesTwist) {
  for (const bool straight : {true, false}) {
    const SaddlePlate saddle =
        bend_into_saddle(rectangle(60, 90), {straight, straight, straight, straight}, kNu);
    EXPECT_NEAR(saddle.stiffness, 2 * (1 - kNu) / 5400, 1e-12);
    EXPECT_NEAR(saddle_stress(rectangle(60, 90), {straight, straight, straight, straight}, kNu,
                              kStressDegree),
                std::sqrt(3.0) * (1 - kNu) / 5400, 1e-12);
    EXPECT_NEAR(saddle.area_mm2, 5400, 1e-9);
    EXPECT_NEAR(saddle.perimeter_mm, 300, 1e-9);
  }
}

// The same place and size whichever corner is first, and seen from any side.
TEST(SaddlePlate, KnowsNoDirections) {
  std::array<Vector2d, 4> corners{Vector2d(0, 0), Vector2d(80, 3), Vector2d(121, 84),
                                  Vector2d(38, 79)};
  std::array<bool, 4> straight{true, true, false, true};
  const double one = bend_into_saddle(corners, straight, kNu).stiffness;
  std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  std::rotate(straight.begin(), straight.begin() + 1, straight.end());
  for (Vector2d& corner : corners) corner = Eigen::Rotation2Dd(0.7) * corner + Vector2d(5, -8);
  EXPECT_NEAR(bend_into_saddle(corners, straight, kNu).stiffness / one, 1, 1e-9);
}

// A softer plate has more freedom; and few polynomials are enough.
TEST(SaddlePlate, FewPolynomialsAreEnough) {
  double worst = 0;
  for (const double lean : {20.0, 40.0}) {
    const std::array<Vector2d, 4> corners{Vector2d(0, 0), Vector2d(80, 0), Vector2d(80 + lean, 80),
                                          Vector2d(lean, 80)};
    double last = 1e300;
    for (const int free : {0, 1, 2}) {
      const std::array<bool, 4> straight{free < 1, free < 2, true, true};
      const double few = bend_into_saddle(corners, straight, kNu).stiffness,
                   many = bend_into_saddle(corners, straight, kNu, 7).stiffness;
      EXPECT_LE(many, few * (1 + 1e-12));
      worst = std::max(worst, few / many - 1);
      EXPECT_LT(few, last);
      last = few;
    }
  }
  RecordProperty("worst", scientific(worst));
  EXPECT_LT(worst, 0.02);  // energies may be off by 3 %
}

// Stress next to the corners of 117 degrees grows with the degree; what counts does not.
TEST(SaddlePlate, StressConverges) {
  const std::array<Vector2d, 4> corners{Vector2d(0, 0), Vector2d(80, 0), Vector2d(120, 80),
                                        Vector2d(40, 80)};
  for (const int free : {0, 1, 2}) {
    const std::array<bool, 4> straight{free < 1, free < 2, true, true};
    const double few = saddle_stress(corners, straight, kNu, kStressDegree),
                 more = saddle_stress(corners, straight, kNu, 9),
                 many = saddle_stress(corners, straight, kNu, 11);
    EXPECT_NEAR(few / many, 1, 0.08);
    EXPECT_NEAR(more / many, 1, 0.02);
  }
}

}  // namespace
}  // namespace misalign::solver
