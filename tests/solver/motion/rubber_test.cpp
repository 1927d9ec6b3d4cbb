// Rubber plates along Table 1's way against coordinates, and chosen cut-outs against all others.
#include "solver/motion/rubber.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <random>

#include "solver/fitting/cut_outs.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;

RubberPlates stretched(double prestretch) {
  RubberPlates plates;
  plates.prestretch = prestretch;
  return plates;
}

struct RubberSheet : testing::Test {
  const TestSheet sheet{6, 6};
  const FlatVertices vertices_mm = sheet.shifted(golden("table1_odd.json")["displacements_mm"]);
  const OwnSheet own{sheet.base, vertices_mm - sheet.base.sheet.vertices_mm};
};

// Principal stretches of the linear map that takes the flat hole's diagonals to the folded one's.
TEST_F(RubberSheet, StretchesAreThoseOfTheDiagonals) {
  for (const double prestretch : {1.0, 1.02, 1.2}) {
    const auto study = study_rubber(own.sheet, {stretched(prestretch), 140.0});
    ASSERT_TRUE(study);
    ASSERT_EQ(study->plates.size(), 8U);
    ASSERT_EQ(study->pilot_deg.size(), 141U);
    for (const PlateWay& plate : study->plates) {
      double largest = 0;
      for (std::size_t row = 0; row < plate.states.size(); ++row) {
        Eigen::Matrix3Xd at_mm = Eigen::Matrix3Xd::Zero(3, vertices_mm.cols());
        at_mm.topRows<2>() = vertices_mm;
        if (row > 0) at_mm = own.sheet.at(study->pilot_deg[row]).vertices_mm;
        const auto& c = plate.corners;
        Eigen::Matrix<double, 3, 2> now;
        now << at_mm.col(c[2]) - at_mm.col(c[0]), at_mm.col(c[3]) - at_mm.col(c[1]);
        Eigen::Matrix2d rest;
        rest << vertices_mm.col(c[2]) - vertices_mm.col(c[0]),
            vertices_mm.col(c[3]) - vertices_mm.col(c[1]);
        const Eigen::Matrix<double, 3, 2> map = prestretch * now * rest.inverse();
        const Eigen::Vector2d stretches =
            Eigen::JacobiSVD<Eigen::Matrix<double, 3, 2>>(map).singularValues();
        const PlateLaw::Stretches& found = plate.states[row].stretches;
        EXPECT_NEAR(found.largest, stretches(0), 1e-9);
        EXPECT_NEAR(found.least, stretches(1), 1e-9);
        const bool is_tense = stretches(1) * std::sqrt(stretches(0)) > 1;
        // Flat plates without a pre-stretch are on the border of all states.
        if (row > 0) {
          EXPECT_EQ(found.tension, is_tense ? Tension::both : Tension::wrinkled);
        }
        largest = std::max(largest, stretches(0));
      }
      EXPECT_NEAR(plate.stretch.value, largest, 1e-9);
    }
  }
}

// A flat plate with a pre-stretch pulls on all its edges with G t (s - 1 / s^5), over the cut-out's
// length, and s times as much over the hole's.
TEST_F(RubberSheet, FlatPlatesPullEvenly) {
  const double s = 1.15;
  const auto study = study_rubber(own.sheet, {stretched(s), 20.0});
  ASSERT_TRUE(study);
  for (const PlateWay& plate : study->plates) {
    for (const double edge : plate.states.front().edge_n_per_mm) {
      EXPECT_NEAR(edge, 0.5 * (s - std::pow(s, -5)) / s, 1e-12);
    }
  }
}

// Springs of 0.95 G t store as much at 36 degrees, within the digits of that number.
TEST_F(RubberSheet, UnstretchedPlatesAreWorthSprings) {
  const auto study = study_rubber(own.sheet, {RubberPlates{}, 36.0});
  ASSERT_TRUE(study);
  const FoldingWay& way = *own.sheet.way();
  Springs springs;
  springs.stiffness_n_per_mm = study->equivalent_n_per_mm;
  Eigen::VectorXd lengths_mm, rates;
  way.find_lengths(way.x_of(36), lengths_mm, rates);
  EXPECT_NEAR(filling_on(way, springs).energy_n_mm(lengths_mm) /
                  filling_on(way, RubberPlates{}).energy_n_mm(lengths_mm),
              1, 0.01);
}

TEST_F(RubberSheet, RefusesAnglesBeyondD) {
  const auto study = study_rubber(own.sheet, {RubberPlates{}, 170.0});
  ASSERT_FALSE(study);
  EXPECT_EQ(study.fault()->name, "from_deg");
}

// Two holes: each pair of cut-outs on the coarse grid, by energies of coordinates a little apart.
TEST(CutOuts, DriveAsWellAsAnyPair) {
  const TestSheet sheet(4, 4);
  std::mt19937 random(57);
  std::uniform_int_distribution<int> ternary(-1, 1);
  for (int draw = 0; draw < 3; ++draw) {
    Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, sheet.base.sheet.vertices_mm.cols());
    for (const int v : interior_vertices(sheet.base.sheet)) {
      shifts_mm.col(v) << 0.4 * ternary(random), 0.4 * ternary(random);
    }
    const OwnSheet own(sheet.base, shifts_mm);
    CutOutOptions options;
    options.from_deg = 90;
    const auto choice = choose_cut_outs(own.sheet, options);
    ASSERT_TRUE(choice);
    const auto slope = [&](Index hole, double one, double other, double deg) {
      const Diagonal &a = sheet.mechanism.diagonals[static_cast<std::size_t>(2 * hole)],
                     &b = sheet.mechanism.diagonals[static_cast<std::size_t>(2 * hole + 1)];
      const auto shape = [&](const auto& at_mm, double by_one, double by_other) {
        const Eigen::VectorXd first = by_one * (at_mm.col(a.to) - at_mm.col(a.from)),
                              second = by_other * (at_mm.col(b.to) - at_mm.col(b.from));
        return HoleShape{first.squaredNorm(), second.squaredNorm(), first.dot(second)};
      };
      const PlateLaw law(0.5, shape(own.sheet.vertices_mm(), one, other));
      const auto energy = [&](double at_deg) {
        const HoleShape now = shape(own.sheet.at(at_deg).vertices_mm, 1, 1);
        return law.at({std::sqrt(now.first_mm2), std::sqrt(now.second_mm2)}, now.product_mm2).n_mm;
      };
      const double apart_deg = 0.01;
      return (energy(deg + apart_deg) - energy(deg - apart_deg)) /
             (4 * deg * apart_deg * kRadPerDeg * kRadPerDeg);
    };
    const std::vector<double> angles_deg = {1, 2, 5, 10, 20, 30, 40, 50, 60, 70, 80, 85, 89, 90};
    const auto drive = [&](Index hole, double one, double other) {
      Eigen::ArrayXd slopes(std::ssize(angles_deg));
      for (Index k = 0; k < slopes.size(); ++k) {
        slopes(k) = slope(hole, one, other, angles_deg[static_cast<std::size_t>(k)]);
      }
      return slopes;
    };
    const auto& cut_outs = choice->plates.cut_outs;
    ASSERT_EQ(cut_outs.size(), 2U);
    Eigen::ArrayXd chosen = Eigen::ArrayXd::Zero(std::ssize(angles_deg));
    for (const CutOut& own_cut : cut_outs) {
      chosen += drive(own_cut.hole, own_cut.of_flat[0], own_cut.of_flat[1]);
    }
    // The least lies at a whole degree, perhaps between these angles.
    EXPECT_GE(chosen.minCoeff(), choice->least_n_mm_per_rad2 * (1 - 1e-4));
    std::vector<Eigen::ArrayXd> all[2];
    for (const Index hole : {0, 1}) {
      for (int i = 0; i < 25; ++i)
        all[hole].push_back(drive(hole, 1 - 0.05 * (i / 5), 1 - 0.05 * (i % 5)));
    }
    double best = -1e9;
    for (const Eigen::ArrayXd& one : all[0]) {
      for (const Eigen::ArrayXd& other : all[1]) best = std::max(best, (one + other).minCoeff());
    }
    EXPECT_GE(chosen.minCoeff(), best * (1 - 1e-4)) << draw;
  }
}

}  // namespace
}  // namespace misalign::solver
