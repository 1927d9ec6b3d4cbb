// Stops of miscut copies against the least energy of springs between vertices of folded copies.
#include "solver/play/miscut_stops.hpp"

#include <cmath>
#include <random>

#include "solver/motion/energy_model.hpp"
#include "solver/play/quantile.hpp"
#include "solver/sheet/sheet_filling.hpp"
#include "tests/solver/bending/bent.hpp"

namespace misalign::solver {
namespace {

constexpr double kStop_deg = 60, kLetGo_deg = 120;

class Stops : public Bent {
 protected:
  static Eigen::Matrix2Xd errors_mm(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-0.05, 0.05);
    Eigen::Matrix2Xd errors(2, 49);
    for (double& error : errors.reshaped()) error = uniform(random);
    return errors;
  }
  OwnSheet copy(unsigned seed) const { return {TestSheet(6, 6).base, shifts() + errors_mm(seed)}; }
  std::optional<double> relaxed_stop(const Sheet& copy, const Fill& fill, double from_deg) const {
    const auto stop = stop_with(copy, fill, from_deg, 0);
    return stop ? std::optional(stop->at_deg) : std::nullopt;
  }
  std::optional<Stop> stop_with(const Sheet& copy, const Fill& fill, double from_deg,
                                double friction_n_mm_per_mm) const {
    const Filling own_filling = filling_on(*own.sheet.way(), fill);
    return solver::stop_of(
        copy.history(),
        own_filling.in_holes(diagonal_products_mm2(copy.mechanism(), copy.vertices_mm())), from_deg,
        friction_n_mm_per_mm);
  }

  // Distances of the diagonals' ends.
  static Eigen::VectorXd lengths_mm(const Sheet& sheet, double pilot_deg) {
    const Eigen::Matrix3Xd& vertices_mm = sheet.at(pilot_deg).vertices_mm;
    Eigen::VectorXd lengths_mm(sheet.mechanism().diagonal_count());
    for (Eigen::Index d = 0; d < lengths_mm.size(); ++d) {
      const Diagonal& diagonal = sheet.mechanism().diagonals[static_cast<std::size_t>(d)];
      lengths_mm(d) = (vertices_mm.col(diagonal.to) - vertices_mm.col(diagonal.from)).norm();
    }
    return lengths_mm;
  }

  // The minimum by thirds, where it is the only one between two angles.
  static double least_deg(const Sheet& copy, const Eigen::VectorXd& free_mm, double low_deg,
                          double high_deg) {
    const auto square = [&](double pilot_deg) {
      return (lengths_mm(copy, pilot_deg) - free_mm).squaredNorm();
    };
    while (high_deg - low_deg > 1e-4) {
      const double third_deg = (high_deg - low_deg) / 3;
      if (square(low_deg + third_deg) < square(high_deg - third_deg)) {
        high_deg -= third_deg;
      } else {
        low_deg += third_deg;
      }
    }
    return (low_deg + high_deg) / 2;
  }
};

// The cubic between stations 1 deg apart is wrong by the fourth derivative of the energy: lengths
// are sums of sines of angles, so that its share is (1 deg in rad)^2 of a degree, 3e-4.
TEST_F(Stops, AreWhereTheSpringsOfTheSheetHaveTheLeastEnergy) {
  const Eigen::VectorXd free_mm = lengths_mm(own.sheet, kStop_deg);
  double least = 180, most = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const OwnSheet miscut = copy(seed);
    const auto found_deg = relaxed_stop(miscut.sheet, Springs{.rest_deg = kStop_deg}, kLetGo_deg);
    ASSERT_TRUE(found_deg);
    EXPECT_NEAR(*found_deg, least_deg(miscut.sheet, free_mm, 30, 90), 1e-3);
    least = std::min(least, *found_deg);
    most = std::max(most, *found_deg);
  }
  EXPECT_GT(most - least, 0.05);  // the errors matter
}

// A copy without errors stops where its filling is relaxed. The second derivative of a plate's
// energy jumps there, from wrinkles in one direction to those in the other: a cubic finds it to a
// twentieth of the step between stations.
TEST_F(Stops, AreTheRestOfTheSheetItself) {
  for (const double at_deg : {kStop_deg, kStop_deg + 0.5}) {
    const auto of_springs = relaxed_stop(own.sheet, Springs{.rest_deg = at_deg}, kLetGo_deg);
    const auto of_plates = relaxed_stop(own.sheet, RubberPlates{.rest_deg = at_deg}, kLetGo_deg);
    ASSERT_TRUE(of_springs && of_plates);
    EXPECT_NEAR(*of_springs, at_deg, 1e-3);
    EXPECT_NEAR(*of_plates, at_deg, 0.05);
  }
}

// The springs' moment at both ends of the range that friction holds, of distances of vertices, is
// that of the creases, of fold angles: each by central differences over 0.1 deg, whose error is
// 1e-6 of the rates; that of rates between stations 1 deg apart is 1e-4 of the friction.
TEST_F(Stops, AreHeldWhereFrictionEqualsTheMomentOfSprings) {
  constexpr double kFriction_n = 0.02, kStep_deg = 0.1;
  const Springs springs{.rest_deg = kStop_deg};
  const OwnSheet miscut = copy(2);
  const Eigen::VectorXd free_mm = lengths_mm(own.sheet, kStop_deg);
  const auto energy = [&](double deg) {
    return springs.stiffness_n_per_mm / 2 * (lengths_mm(miscut.sheet, deg) - free_mm).squaredNorm();
  };
  const auto turned = [&](double deg) -> double {
    return crease_lengths_mm(*miscut.sheet.way()).dot(miscut.sheet.at(deg).fold_deg.cwiseAbs()) *
           kRadPerDeg;
  };
  const auto excess = [&](double deg, int sense) {
    const double up = deg + kStep_deg, down = deg - kStep_deg;
    const double friction = kFriction_n * (turned(up) - turned(down));
    return (sense * (energy(up) - energy(down)) - friction) / friction;
  };
  const auto stop = stop_with(miscut.sheet, springs, kLetGo_deg, kFriction_n);
  ASSERT_TRUE(stop);
  EXPECT_NEAR(excess(stop->at_deg, 1), 0, 2e-3);
  EXPECT_NEAR(excess(stop->held_from_deg, -1), 0, 2e-3);
  const double relaxed_deg = *relaxed_stop(miscut.sheet, springs, kLetGo_deg);
  EXPECT_LT(stop->held_from_deg, relaxed_deg - 1);
  EXPECT_GT(stop->at_deg, relaxed_deg + 1);
  // More friction than springs have moment at the start: it does not move.
  EXPECT_FALSE(stop_with(miscut.sheet, springs, kLetGo_deg, 100));
}

TEST_F(Stops, AreFlatOrNone) {
  EXPECT_EQ(relaxed_stop(own.sheet, Springs{}, 36), 0);
  const OwnSheet miscut = copy(3);
  EXPECT_FALSE(relaxed_stop(miscut.sheet, Springs{.rest_deg = kStop_deg}, 40));  // it folds on
  EXPECT_FALSE(relaxed_stop(miscut.sheet, Springs{.rest_deg = kStop_deg}, 185));
}

TEST(MiscutStops, CountAndSort) {
  MiscutStops stops, others;
  for (const double deg : {61.0, 59.0, 60.0}) stops.add(Stop{deg, deg - 1});
  stops.add(Stop{0, 0});
  others.add(Stop{58, 57});
  others.add(std::nullopt);
  stops.add(others);
  const std::vector<double> sorted = stops.sorted(&Stop::at_deg);
  EXPECT_EQ(sorted, (std::vector<double>{58, 59, 60, 61}));
  EXPECT_EQ(stops.flat, 1);
  EXPECT_EQ(stops.held, 1);
  EXPECT_EQ(stops.trials(), 6);
  EXPECT_EQ(quantile(sorted, 0), 58);
  EXPECT_EQ(quantile(sorted, 0.5), 59);
  EXPECT_EQ(quantile(sorted, 1), 61);
}

}  // namespace
}  // namespace misalign::solver
