// Panels that bend, against closed forms, differences and the rigid sheet.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "solver/bending/bent_advice.hpp"
#include "tests/solver/bending/bent.hpp"
#include "tests/solver/families.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Two rectangles on one crease, folded by phi, and a spring across from corner to corner.
struct TwoBentPanels {
  static constexpr double kA = 60, kB = 90, kNu = 0.33;
  TwoBentPanels() {
    flat_mm.resize(2, 6);
    flat_mm << 0, kA, 2 * kA, 0, kA, 2 * kA, 0, 0, 0, kB, kB, kB;
    panels.facets = {0, 1};
    panels.corners = {{0, 1, 4, 3}, {1, 2, 5, 4}};
    panels.folds = {{1, 4, 0, 1, 1}};
  }
  ElasticSheet sheet(double thickness_mm, double stiffer) const {
    return {flat_mm, panels, {{0, 0, 0, 0, 2}, {0, 0, 0, 3, 5}}, {70, kNu}, thickness_mm, stiffer};
  }
  Matrix3Xd folded(double phi) const {
    const double c = kA * std::cos(phi / 2), s = kA * std::sin(phi / 2);
    Matrix3Xd at(3, 6);
    at << -c, 0, c, -c, 0, c, 0, 0, 0, kB, kB, kB, s, 0, s, s, 0, s;
    return at;
  }
  static double saddle_n_per_mm(double t) {
    const double rigidity = 70e3 * t * t * t / 12 / (1 - kNu * kNu);
    return rigidity * 2 * (1 - kNu) / (kA * kB) / (1 + kFreeEdge * t * 2 * (kA + kB) / (kA * kB));
  }
  FlatVertices flat_mm;
  Panels panels;
};

// With the mean normals held a corner goes off its plane by q / 2; the spring sees sin(phi / 2) of
// it, of both panels: C = sin^2(phi / 2) / 2 K.
TEST(BentState, TwoPanelsByHand) {
  constexpr double kInPlane = 1e-5;  // panels give 1e-8 mm/N there, of 2e-3 and more in bending
  const TwoBentPanels two;
  const double thickness_mm = 1.5, k_saddle = TwoBentPanels::saddle_n_per_mm(thickness_mm);
  const ElasticSheet sheet = two.sheet(thickness_mm, 1e4);
  for (const double phi : {0.3, 1.2, 2.5}) {
    const Compliance give = find_compliance(sheet, two.folded(phi)).value();
    const double by_hand = std::pow(std::sin(phi / 2), 2) / (2 * k_saddle);
    EXPECT_NEAR(give.mm_per_n(0, 0) / by_hand, 1, kInPlane);
    EXPECT_NEAR(give.turned_mm, TwoBentPanels::kB * phi, 1e-9);
    EXPECT_NEAR(std::abs(give.saddle_mm_per_n(0, 0)), std::sin(phi / 2) / (2 * k_saddle),
                kInPlane / k_saddle);
    const double longer = 2 * TwoBentPanels::kA * (std::cos(phi / 2) - 1);
    const Filling one = Filling::of_springs(Eigen::Vector2d(3, 0), sheet.flat_lengths_mm());
    const BentState state = bend(give, one);
    EXPECT_NEAR(state.n_mm / (longer * longer / 2 / (1 / 3.0 + by_hand)), 1, kInPlane);
  }
}

// A square bent into a saddle, its sides as long as flat: to the energy of twist come the 3.89e-4
// E t q^4 / 2 a^2 of a clamped square's volume (0.00126 a^4 high in the middle; Timoshenko &
// Woinowsky-Krieger, table 35).
TEST(ElasticSheet, SquareStretchesInALargeSaddle) {
  FlatVertices flat_mm(2, 4);
  flat_mm << 0, 80, 80, 0, 0, 0, 80, 80;
  Panels panels;
  panels.facets = {0};
  panels.corners = {{0, 1, 2, 3}};
  const double q = 3, e = 70e3, t = 0.5;
  const ElasticSheet sheet(flat_mm, panels, {}, {70, TwoBentPanels::kNu}, t);
  Matrix3Xd at_mm = sheet.flat_shape_mm();
  at_mm.row(2) << q / 4, -q / 4, q / 4, -q / 4;  // each side rises by q / 2
  at_mm.topRows<2>() *= std::sqrt(1 - std::pow(q / 2 / 80, 2));
  const double seen_mm = sheet.saddles_mm(at_mm)(0);  // over a plan that is smaller
  const double twist = sheet.saddle_n_per_mm()(0) / 2 * seen_mm * seen_mm;
  const double stretch = 3.891e-4 * e * t * std::pow(seen_mm, 4) / 2 / 6400;
  EXPECT_NEAR((sheet.panels_energy(at_mm).n_mm - twist) / stretch, 1, 2e-3);
}

// Whichever corner is first: a parallelogram in a saddle larger than it is thick.
TEST(ElasticSheet, KnowsNoDirections) {
  FlatVertices flat_mm(2, 4);
  flat_mm << 0, 80, 120, 40, 0, 4, 84, 80;
  std::array<double, 2> energies_n_mm{};
  for (const int first : {0, 1}) {
    Panels panels;
    panels.facets = {0};
    panels.corners = {{first, first + 1, first + 2, (first + 3) % 4}};
    const ElasticSheet sheet(flat_mm, panels, {}, {70, TwoBentPanels::kNu}, 0.2);
    Matrix3Xd at_mm = sheet.flat_shape_mm();
    at_mm.row(2) << 0.8, -0.7, 0.8, -0.9;
    energies_n_mm[static_cast<std::size_t>(first)] = sheet.panels_energy(at_mm).n_mm;
  }
  EXPECT_NEAR(energies_n_mm[1] / energies_n_mm[0], 1, 1e-9);
}

// Gradients and second derivatives by differences, of a sheet that is out of every shape.
TEST_F(Bent, Derivatives) {
  const ElasticSheet sheet = panels();
  std::mt19937 random(38);
  std::normal_distribution<double> off_mm(0, 0.3);
  Matrix3Xd at_mm = folded(50);
  for (Index i = 0; i < at_mm.size(); ++i) at_mm.data()[i] += off_mm(random);
  const Filling filling = springs(20, 0.99 * sheet.flat_lengths_mm());
  const VectorXd none_n = VectorXd::Zero(sheet.diagonals());
  const auto energy_at = [&](const Matrix3Xd& place_mm) {
    ElasticSheet::Energy energy = sheet.panels_energy(place_mm);
    sheet.add_filling(place_mm, filling, none_n, energy);
    return energy;
  };
  ElasticSheet::Energy energy = energy_at(at_mm);
  MatrixXd turned = MatrixXd::Zero(sheet.coordinates(), sheet.coordinates());
  sheet.add_turned_bend(at_mm, 1, turned);
  const VectorXd turned_slope = sheet.turned_slope(at_mm), saddles = sheet.saddles_mm(at_mm);
  const MatrixXd saddle_slopes = sheet.saddle_slopes(at_mm),
                 length_slopes = sheet.length_slopes(at_mm);
  constexpr double kStep = 1e-4;  // errors of its square, 1e-8 of what bends within a mm
  for (Index i = 0; i < at_mm.size(); i += 5) {
    Matrix3Xd above = at_mm, below = at_mm;
    above.data()[i] += kStep;
    below.data()[i] -= kStep;
    const ElasticSheet::Energy up = energy_at(above), down = energy_at(below);
    EXPECT_NEAR((up.n_mm - down.n_mm) / (2 * kStep), energy.slope(i), 1e-6 * energy.slope.norm());
    EXPECT_LT(((up.slope - down.slope) / (2 * kStep) - energy.bend.col(i)).norm(),
              1e-6 * energy.bend.norm());
    EXPECT_NEAR((sheet.turned_mm(above) - sheet.turned_mm(below)) / (2 * kStep), turned_slope(i),
                1e-6 * turned_slope.norm());
    EXPECT_LT(
        ((sheet.turned_slope(above) - sheet.turned_slope(below)) / (2 * kStep) - turned.col(i))
            .norm(),
        1e-5 * turned.norm());
    EXPECT_LT(
        ((sheet.saddles_mm(above) - sheet.saddles_mm(below)) / (2 * kStep) - saddle_slopes.col(i))
            .norm(),
        1e-6);
    EXPECT_LT(
        ((sheet.lengths_mm(above) - sheet.lengths_mm(below)) / (2 * kStep) - length_slopes.col(i))
            .norm(),
        1e-6);
  }
}

// A rigid folded sheet has no energy, and its creases' sum is that of the fold angles.
TEST_F(Bent, FoldedSheetIsRelaxed) {
  const ElasticSheet sheet = panels();
  const Matrix3Xd at_mm = folded(36);
  const ElasticSheet::Energy energy = sheet.panels_energy(at_mm);
  EXPECT_LT(energy.n_mm, 1e-12);
  EXPECT_LT(energy.slope.norm(), 1e-5);
  VectorXd angles, rates;
  own.sheet.way()->find_creases(own.sheet.way()->x_of(36), angles, rates);
  double sum = 0;
  for (std::size_t k = 0; k < own.sheet.mechanism().creases.size(); ++k) {
    const Crease& crease = own.sheet.mechanism().creases[k];
    sum += std::abs(angles(static_cast<Index>(k))) *
           (own.sheet.point_mm(crease.a) - own.sheet.point_mm(crease.b)).norm();
  }
  EXPECT_NEAR(sheet.turned_mm(at_mm) / sum, 1, 1e-10);
}

// With weak springs both methods agree, to what is of second order; with strong ones Newton's
// method is at rest, and its multiplier is how the energy changes.
TEST_F(Bent, NewtonAndLinear) {
  const ElasticSheet sheet = panels();
  const auto bent_at = [&](double pilot_deg, double n_per_mm) {
    const Matrix3Xd at_mm = folded(pilot_deg);
    const Filling filling = springs(n_per_mm, sheet.flat_lengths_mm());
    BentFollower follower(sheet, filling, at_mm);
    EXPECT_TRUE(follower.follow(sheet.turned_mm(at_mm)));
    return follower.state();
  };
  const Filling weak = springs(1e-4, sheet.flat_lengths_mm());
  const BentFollower::State far = bent_at(36, 1e-4);
  EXPECT_NEAR(far.n_mm / bend(find_compliance(sheet, folded(36)).value(), weak).n_mm, 1, 1e-5);
  const BentFollower::State middle = bent_at(36, 50), above = bent_at(36.01, 50),
                            below = bent_at(35.99, 50);
  const double turned_mm = sheet.turned_mm(folded(36.01)) - sheet.turned_mm(folded(35.99));
  EXPECT_NEAR((above.n_mm - below.n_mm) / turned_mm / middle.moment_n, 1, 1e-5);
  EXPECT_NEAR(sheet.turned_mm(middle.at_mm), sheet.turned_mm(folded(36)), 1e-8);
  // At rest: what is left of all forces is the multiplier's.
  ElasticSheet::Energy energy = sheet.panels_energy(middle.at_mm);
  sheet.add_filling(middle.at_mm, springs(50, sheet.flat_lengths_mm()),
                    VectorXd::Zero(sheet.diagonals()), energy);
  const VectorXd left_n = energy.slope - middle.moment_n * sheet.turned_slope(middle.at_mm);
  EXPECT_LT(left_n.norm(), 1e-7 * middle.forces_n.norm());
}

// As stiff as rock it is the rigid sheet; soft, what is left goes with the thickness's cube, but
// for edges (1.5 % a mm) and what panels give in their planes.
TEST_F(Bent, FromRigidToSoft) {
  ReleaseOptions deploying;
  BentPanelsOptions rock;
  rock.material.e_gpa = 1e11;
  rock.method = BendMethod::linear;
  const BentPanels rigid = bent(deploying, rock);
  const EnergyModel as_rigid(own.sheet, {});
  EXPECT_NEAR(*rigid.friction.critical_n_mm_per_mm /
                  *find_friction_limits(as_rigid, 36).critical_n_mm_per_mm,
              1, 1e-4);
  EXPECT_NEAR(rigid.angles.back().bent.n_mm / rigid.angles.back().rigid_n_mm, 1, 1e-6);
  deploying.sheet.springs().stiffness_n_per_mm = 1e5;
  BentPanelsOptions linear;
  linear.method = BendMethod::linear;
  deploying.sheet.plates.thickness_mm = 0.5;
  const double thin = *bent(deploying, linear).friction.critical_n_mm_per_mm;
  deploying.sheet.plates.thickness_mm = 1;
  EXPECT_NEAR(*bent(deploying, linear).friction.critical_n_mm_per_mm / thin, 8, 0.16);
}

// Wires, and plates that are slack when flat, bend panels too: as stiff as rock they are the rigid
// sheet's. A filling without energy bends nothing.
TEST_F(Bent, FillingsThatAreSlackWhenFlat) {
  BentPanelsOptions rock;
  rock.material.e_gpa = 1e11;
  rock.method = BendMethod::linear;
  for (const Fill& fill : {Fill(Springs{.pull_only = true}), Fill(RubberPlates{})}) {
    ReleaseOptions deploying;
    deploying.sheet.fill = fill;
    const BentPanels rigid = bent(deploying, rock);
    const EnergyModel as_rigid(own.sheet, deploying.sheet);
    EXPECT_NEAR(*rigid.friction.critical_n_mm_per_mm /
                    *find_friction_limits(as_rigid, 36).critical_n_mm_per_mm,
                1, 1e-3)
        << fill.index();
  }
  ReleaseOptions nothing;
  nothing.sheet.fill = NoFill{};
  EXPECT_EQ(bend_panels(own.sheet, nothing, rock).fault()->name, "fill");
}

// E = c S^4 / (1 + S^2 / d^2), S = a rho: from the fourth power to the second.
TEST(EnergyCurve, ThroughTheBend) {
  const double a = 30, c = 1e-9, d = 100;
  const VectorXd angles_deg = EnergyCurve::angles_deg(0.9, 36, 16);
  const Eigen::ArrayXd s = a * angles_deg.array();
  const VectorXd energy = c * s.pow(4) / (1 + s.square() / (d * d));
  const EnergyCurve curve(0.9, 36, energy, 0.3 * energy, s);
  for (const double at_deg : {0.95, 1.0, 2.0, 5.0, 17.0, 35.5}) {
    const double sum = a * at_deg, soft = 1 + sum * sum / (d * d);
    const EnergyCurve::At at = curve.at(at_deg);
    EXPECT_NEAR(at.turned_mm / sum, 1, 1e-9);
    EXPECT_NEAR(at.n_mm / (c * std::pow(sum, 4) / soft), 1, 1e-4);
    const double slope =
        c * (4 * std::pow(sum, 3) * soft - std::pow(sum, 5) * 2 / (d * d)) / soft / soft;
    EXPECT_NEAR(at.moment_n / slope, 1, 1e-3);
  }
}

// E = b S^2 / 2: a moment b S. Critical b S / 2 from the start; static b S at the end; stalls where
// b S is the friction.
TEST(BentFriction, OfAQuadraticEnergy) {
  const double a = 25, b = 2e-5;
  const VectorXd angles_deg = EnergyCurve::angles_deg(0.9, 40, 12);
  const VectorXd sums = a * angles_deg, energy = b / 2 * sums.array().square();
  const EnergyCurve curve(0.9, 40, energy, energy, sums);
  const auto nothing = [](double) { return OtherMoments{0, 0, 0}; };
  const BentFriction found = find_bent_friction(curve, 1, b * a * 10, nothing);
  EXPECT_NEAR(*found.critical_n_mm_per_mm / (b * a * 40 / 2), 1, 1e-9);
  EXPECT_NEAR(found.critical_deg, 0, 1e-9);
  EXPECT_NEAR(found.static_n_mm_per_mm / (b * a), 1, 1e-9);
  EXPECT_NEAR(*found.static_margin, 0.1 - 1, 1e-9);
  EXPECT_NEAR(*found.static_stall_deg, 10, 1e-6);
  // Ball joints with the half of it: stalls earlier, and what is left for creases is less.
  const auto balls = [&](double) { return OtherMoments{0, 0, b * a * 5}; };
  const BentFriction with_balls = find_bent_friction(curve, 1, b * a * 10, balls);
  EXPECT_NEAR(*with_balls.static_stall_deg, 15, 1e-6);
  EXPECT_NEAR(*with_balls.critical_n_mm_per_mm / (b * a * (20 - 5)), 1, 1e-3);
}

// A sheet of 0.2 mm with shifts of 4 mm, whose panels take nine tenths of the springs' stretch:
// near flat other equilibria lie close by, of 3 to 20 times the energy. From a continuation in
// steps of 6 % of the sum with second derivatives by differences, and at 1.34 degrees from CalculiX
// (results/bending/far.md).
TEST(BentPanels, FollowsItsEquilibrium) {
  const TestSheet base(4, 4);
  const Json shifts_mm = Json::parse(R"({"A7": [4, -4], "A8": [-4, 0], "A9": [-4, 0],
      "A12": [4, -4], "A13": [4, -4], "A14": [0, 4], "A17": [4, 4], "A18": [-4, 4],
      "A19": [4, -4]})");
  const OwnSheet own(base.base, base.shifted(shifts_mm) - base.base.sheet.vertices_mm);
  ReleaseOptions deploying;
  deploying.from_deg = 60;
  deploying.sheet.plates.thickness_mm = 0.2;
  const BentPanels bent = *bend_panels(own.sheet, deploying);
  EXPECT_EQ(bent.method, BendMethod::newton);
  EXPECT_EQ(bent.unsure(), 0);
  const std::array<double, 3> continued_n_mm{4.580e-5, 6.389e-5, 1.0677e-4};
  for (std::size_t k = 0; k < continued_n_mm.size(); ++k) {
    EXPECT_NEAR(bent.angles[k + 1].bent.n_mm / continued_n_mm[k], 1, 5e-3);
  }
  EXPECT_NEAR(bent.angles[3].bent.n_mm / 1.0672e-4, 1, 0.03);
  EXPECT_NEAR(bent.angles.back().bent.n_mm / 0.62258, 1, 5e-3);
}

// What the springs that are called useful overcome, of what much stiffer ones do.
TEST(BentPanels, UsefulSprings) {
  const TestSheet base(4, 4);
  const Json shifts_mm = Json::parse(
      R"({"A13": [0, 0.4], "A14": [0.4, -0.4], "A17": [0.4, 0], "A18": [-0.4, -0.4], "A19": [0, -0.4], "A8": [-0.4, -0.4], "A9": [0.4, 0.4]})");
  const OwnSheet own(base.base, base.shifted(shifts_mm) - base.base.sheet.vertices_mm);
  const BentWay way(own.sheet, {}, 0.5, 1, 90, 16);
  const double useful = useful_stiffness_n_per_mm(way).value();
  const auto critical = [&](double n_per_mm) {
    ReleaseOptions deploying;
    deploying.from_deg = 90;
    deploying.sheet.plates.thickness_mm = 0.5;
    deploying.sheet.springs().stiffness_n_per_mm = n_per_mm;
    return *bend_panels(own.sheet, deploying)->friction.critical_n_mm_per_mm;
  };
  EXPECT_NEAR(critical(useful) / critical(1e6), kUseful, 0.01);
}

}  // namespace
}  // namespace misalign::solver
