// The way of a folding path as functions of one coordinate, and what follows from it, against
// vertex coordinates and other solvers.
#include "solver/sheet/folding_way.hpp"

#include <gtest/gtest.h>

#include "solver/motion/deploy.hpp"
#include "solver/motion/joint_forces.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/coordinate_mass.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"
#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::solver {
namespace {

constexpr int kPlaces = 20;

// Polynomials of the seventh degree come back, and the sine to step^8 of its eighth derivative.
TEST(SmoothTable, PolynomialsAndSines) {
  const double step = 0.05;
  Eigen::MatrixXd values(4, kPlaces);
  for (int k = 0; k < kPlaces; ++k) {
    const double x = (k + 0.5) * step;
    values.col(k) << 1 - x * x + 3 * std::pow(x, 6), x - 2 * std::pow(x, 7), std::cos(x),
        std::sin(x);
  }
  using enum SmoothTable::Parity;
  const SmoothTable table(values, {even, odd, even, odd}, step);
  EXPECT_DOUBLE_EQ(table.end(), 1);
  Eigen::VectorXd found, slopes;
  for (double x = -1; x <= 1; x += 0.0173) {
    table.find(x, 0, 4, found, slopes);
    EXPECT_NEAR(found(0), 1 - x * x + 3 * std::pow(x, 6), 1e-13);
    EXPECT_NEAR(slopes(0), -2 * x + 18 * std::pow(x, 5), 1e-11);
    EXPECT_NEAR(found(1), x - 2 * std::pow(x, 7), 1e-13);
    EXPECT_NEAR(slopes(1), 1 - 14 * std::pow(x, 6), 1e-11);
    // Half a step beyond the last of eight places: 0.2 step^8 = 8e-12, and step^7 for slopes.
    EXPECT_NEAR(found(2), std::cos(x), 1e-11);
    EXPECT_NEAR(slopes(2), -std::sin(x), 1e-9);
    EXPECT_NEAR(found(3), std::sin(x), 1e-11);
    EXPECT_EQ(table.value(x, 3), found(3));
    table.find(x, 2, 1, found, slopes);
    EXPECT_EQ(table.value(x, 2), found(0));
  }
}

struct Table1Way : testing::Test {
  Table1Way()
      : sheet(6, 6),
        vertices_mm(sheet.shifted(golden("table1_odd.json")["displacements_mm"])),
        model(sheet.base),
        way(way_of(model, vertices_mm).value()) {}

  Eigen::Matrix3Xd shape_mm(double x) const {
    FoldState<double> state = way.stations().front().state;
    way.find_state(x, state);
    return model.shape().vertices_mm(way.geometry(), state);
  }
  EnergyModel released(const EnergyModel::Options& options = {}) const {
    return EnergyModel(way, model.shape(), sheet.base, options);
  }

  const TestSheet sheet;
  const FlatVertices vertices_mm;
  const Model model;
  const FoldingWay way;
};

TEST_F(Table1Way, EndsAtItsFoldLimit) {
  EXPECT_TRUE(way.ends_at_limit());
  EXPECT_NEAR(way.end_deg(), 156.3487, 1e-4);  // three programs' number
  EXPECT_FALSE(way.over_folded_deg());
  for (const double pilot_deg : {-120.0, 0.0, 36.0, 156.3}) {
    EXPECT_NEAR(way.pilot_deg(way.x_of(pilot_deg)), pilot_deg, 1e-11);
  }
}

// Everywhere between stations, next to the limit too; by vertex coordinates, which know no joint.
TEST_F(Table1Way, StatesAndLengthsAreThoseOfVertexCoordinates) {
  VertexCoordinates other(sheet.base, vertices_mm, shape_mm(way.x_of(5)), 5);
  Eigen::VectorXd lengths_mm, rates;
  // Polynomials of 60 stations: 1e-10 where nothing bends much, 1e-6 two degrees before the limit.
  for (const auto& [pilot_deg, error_mm] :
       {std::pair(5.0, 1e-9), {36.0, 1e-9}, {90.5, 1e-9}, {120.0, 1e-9}, {150.1, 1e-7}}) {
    ASSERT_TRUE(other.fold_to(pilot_deg));
    const double x = way.x_of(pilot_deg);
    way.find_lengths(x, lengths_mm, rates);
    for (int d = 0; d < way.mechanism().diagonal_count(); ++d) {
      const Diagonal& diagonal = way.mechanism().diagonals[static_cast<std::size_t>(d)];
      EXPECT_NEAR(lengths_mm(d), other.distance_mm(diagonal.from, diagonal.to), error_mm)
          << pilot_deg;
    }
    const Eigen::Matrix3Xd shape = shape_mm(x), expected = other.points_mm();
    for (Eigen::Index v = 1; v < shape.cols(); ++v) {
      EXPECT_NEAR((shape.col(v) - shape.col(0)).norm(), (expected.col(v) - expected.col(0)).norm(),
                  10 * error_mm);
    }
  }
}

// Differences of coordinates with the best rigid motion taken off; h^2 of a third derivative.
TEST_F(Table1Way, MassIsThatOfVertexCoordinates) {
  const EnergyModel deploying = released();
  VertexCoordinates other(sheet.base, vertices_mm, shape_mm(way.x_of(5)), 5);
  const double h_deg = 0.01;
  for (const double pilot_deg : {10.0, 36.0, 90.0, 140.0}) {
    ASSERT_TRUE(other.fold_to(pilot_deg - h_deg));
    const Eigen::Matrix3Xd before = other.points_mm();
    ASSERT_TRUE(other.fold_to(pilot_deg + h_deg));
    const double expected = mass_of_coordinates(sheet.base, Plates{}, before, other.points_mm(),
                                                2 * h_deg * kRadPerDeg);
    const double x = way.x_of(pilot_deg), rate = way.pilot_rate(x);
    EXPECT_NEAR(deploying.at(x).mass / (rate * rate) / expected, 1, 1e-6) << pilot_deg;
  }
}

// The numbers of programs that share no code with this one, to the digits they gave.
TEST_F(Table1Way, ReleasedAt36Degrees) {
  const EnergyModel deploying = released();
  const Deployment run = deploy(deploying, {0.0}, {});
  EXPECT_EQ(run.outcome, Outcome::passed_flat);
  EXPECT_NEAR(run.rows.front().springs_n_mm, 5.538, 5e-4);
  const auto mass_kg_mm2 = [&](double pilot_deg) {
    const double x = way.x_of(pilot_deg), rate = way.pilot_rate(x);
    return 1e3 * deploying.at(x).mass / (rate * rate);
  };
  EXPECT_NEAR(mass_kg_mm2(36), 309.0, 0.05);
  EXPECT_NEAR(mass_kg_mm2(0.5), 81.4, 0.05);
  for (const auto& [pilot_deg, time_s] :
       {std::pair(30.0, 0.0433), {20.0, 0.0704}, {10.0, 0.0892}, {5.0, 0.0972}}) {
    const auto at = std::find_if(run.rows.begin(), run.rows.end(), [&](const Deployment::Row& row) {
      return std::abs(row.pilot_deg - pilot_deg) < 1e-9;
    });
    ASSERT_NE(at, run.rows.end()) << pilot_deg;
    EXPECT_NEAR(at->time_s, time_s, 5.1e-5);
  }
}

TEST_F(Table1Way, EnergyIsKeptOverTenSwings) {
  const int turns = 20 / kFewer;
  const Deployment run = deploy(released(), {0.0}, {.swings = turns});
  EXPECT_EQ(run.outcome, Outcome::passed_flat);  // for the next time
  const double energy = run.rows.front().total_n_mm;
  double worst = 0;
  for (const Deployment::Row& row : run.rows) {
    worst = std::max(worst, std::abs(row.total_n_mm / energy - 1));
  }
  EXPECT_LT(worst, 1e-8);
  RecordProperty("energy_error", scientific(worst));
}

// Whatever the mass, and from wherever it is let go.
TEST_F(Table1Way, CriticalFrictionIsWhereTheMotionJustArrives) {
  for (const double from_deg : {36.0, 120.0}) {
    const auto limit = find_friction_limits(released(), from_deg).critical_n_mm_per_mm;
    ASSERT_TRUE(limit);
    for (const double density : {2.7, 0.5}) {
      EnergyModel::Options options;
      options.plates.density_g_per_cm3 = density;
      for (const double share : {0.999, 1.001}) {
        options.joints.friction_n_mm_per_mm = share * *limit;
        const Deployment run = deploy(released(options), {0.0}, {.from_deg = from_deg});
        EXPECT_EQ(run.outcome == Outcome::passed_flat, share < 1) << from_deg << " " << share;
      }
      options.joints.friction_n_mm_per_mm = *limit;
      EXPECT_NEAR(*find_friction_limits(released(options), from_deg).stiffness_needed_n_per_mm,
                  Springs{}.stiffness_n_per_mm, 1e-6);
    }
  }
}

// Springs relaxed on the way: one well there, flat between it and its mirror image, and a second
// derivative that the rates of the close steps' path give as well.
TEST_F(Table1Way, RestsWhereSpringsAreRelaxed) {
  const FoldingHistory history = sheet.history(vertices_mm);
  for (const int rest_deg : {30, 60, 90, 120}) {
    EnergyModel::Options options;
    options.springs().rest_deg = rest_deg;
    const EnergyModel deploying = released(options);
    const std::vector<Equilibrium> found = find_equilibria(deploying);
    ASSERT_EQ(found.size(), 3u) << rest_deg;
    EXPECT_EQ(found[1].x, 0);
    EXPECT_FALSE(found[1].is_well);
    EXPECT_TRUE(found[0].is_well && found[2].is_well);
    EXPECT_NEAR(found[2].pilot_deg, rest_deg, 1e-6);
    EXPECT_NEAR(found[0].pilot_deg, -rest_deg, 1e-6);
    const double slope_sq =
        history.slope_mm_per_deg.row(rest_deg - 1).squaredNorm() / (kRadPerDeg * kRadPerDeg);
    EXPECT_NEAR(found[2].stiffness_n_mm / (50 * slope_sq), 1, 1e-5);
  }
}

TEST_F(Table1Way, ComesToRestThere) {
  EnergyModel::Options options;
  options.springs().rest_deg = 60;
  options.joints.damping_n_mm_s_per_mm = 0.01;
  const double well_x = way.x_of(60);
  for (const double from_deg : {30.0, 156.0}) {
    const Deployment run = deploy(released(options), {-well_x, well_x}, {.from_deg = from_deg});
    EXPECT_EQ(run.outcome, Outcome::at_rest) << from_deg;
    EXPECT_NEAR(run.last().pilot_deg, 60, Deployment::Options{}.well_deg);
  }
}

// Balanced with inertia, nothing holds the sheet; without, the springs' own moment does. Of the
// reactions as many are known as the panels' freedoms leave: 28 * 6 - 6 - 1.
TEST_F(Table1Way, ForcesBalanceEveryPanel) {
  const EnergyModel deploying = released();
  Deployment run = deploy(deploying, {0.0}, {});
  for (std::size_t k = 0; k < 6; ++k) run.rows[k] = run.rows[1 + 11 * k];
  run.rows.resize(6);
  for (const bool in_motion : {true, false}) {
    const JointForces forces =
        find_joint_forces(deploying, model.shape(), sheet.base, run, {.in_motion = in_motion});
    EXPECT_EQ(forces.reactions, 167);
    EXPECT_EQ(forces.rank, 161);
    EXPECT_EQ(std::count(forces.crease_shared.begin(), forces.crease_shared.end(), true), 8);
    for (std::size_t k = 0; k < run.rows.size(); ++k) {
      const double x = run.rows[k].x, moment = deploying.at(x).slope / way.pilot_rate(x);
      EXPECT_NEAR(forces.holding_n_mm[k], in_motion ? 0 : -moment, 1e-6 * moment);
    }
    EXPECT_GT(forces.ball_force_n.cwiseAbs().maxCoeff(), 0.1);
  }
}

}  // namespace
}  // namespace misalign::solver
