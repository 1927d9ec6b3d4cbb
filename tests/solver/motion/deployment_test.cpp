// Deployment of sheets against closed forms: two panels on one hinge, and a single vertex.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "solver/motion/deploy.hpp"
#include "solver/motion/joint_forces.hpp"
#include "tests/solver/coordinate_mass.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

constexpr double kPanel_mm = 60, kAlong_mm = 90;

// Two rectangles side by side and a valley between them; the way is the fold angle itself.
struct TwoPanels {
  TwoPanels() {
    CreasePattern& sheet = base.sheet;
    sheet.vertices_mm.resize(2, 6);
    sheet.vertices_mm << 0, kPanel_mm, 2 * kPanel_mm, 0, kPanel_mm, 2 * kPanel_mm,  //
        0, 0, 0, kAlong_mm, kAlong_mm, kAlong_mm;
    sheet.facets = {{0, 1, 4, 3}, {1, 2, 5, 4}};
    sheet.places = {{0, 0}, {0, 1}};
    sheet.edges = edges_of(sheet.facets);
    sheet.panel_width_mm = kPanel_mm;
    const int edge = find_edge(sheet, 1, 4);
    mechanism = {sheet.edges, {{edge, 1, 4, 0, 1, 1, 0}}, {}, {}, {}, 0, 6, 1, 0, 1, kPanel_mm};
    constexpr int kStations = 60;
    const double end = 170 * kRadPerDeg, step = end / kStations;
    std::vector<WayStation> stations;
    for (int k = 0; k < kStations; ++k) {
      const double half = (k + 0.5) * step / 2;
      stations.push_back({{{{std::cos(half), std::sin(half)}}, {}}, {1.0}});
    }
    way.emplace(mechanism, sheet.vertices_mm, WayCoordinate{0}, step, end, std::move(stations));
    shape.emplace(sheet, std::vector<int>{}, mechanism);
  }
  EnergyModel sheet(const EnergyModel::Options& options) const {
    return EnergyModel(*way, *shape, base, options);
  }

  PerforatedSheet base;
  Mechanism mechanism;
  std::optional<FoldingWay> way;
  std::optional<FoldedShape> shape;
};

// One panel held, the other on an elastic hinge: an oscillator.
struct Oscillator : TwoPanels, testing::Test {
  Oscillator() {
    options.held = HeldPanel{0};
    options.joints.stiffness_n_mm_per_mm = 0.02;
    mass = options.plates.area_density() * kPanel_mm * kAlong_mm;
    inertia = mass * kPanel_mm * kPanel_mm / 3;
    stiffness = options.joints.stiffness_n_mm_per_mm * kAlong_mm;
    frequency = std::sqrt(stiffness / inertia);
    run.from_deg = 60;
  }
  Deployment released() const { return deploy(sheet(options), {0.0}, run); }

  EnergyModel::Options options;
  Deployment::Options run;
  double mass, inertia, stiffness, frequency;
};

// Times and angles to 1e-8: a hundred steps, each within the integrator's 1e-11.
constexpr double kTimes = 1e-8;

TEST_F(Oscillator, SwingsAsOneDoes) {
  const Deployment deployment = released();
  EXPECT_EQ(deployment.outcome, Outcome::passed_flat);
  const double quarter_s = kPi / 2 / frequency;
  EXPECT_NEAR(deployment.last().time_s / quarter_s, 1, kTimes);
  EXPECT_NEAR(deployment.last().rate_deg_per_s / (-60 * frequency), 1, kTimes);
  double last_deg = 60;
  for (const Deployment::Row& row : deployment.rows) {
    EXPECT_NEAR(row.pilot_deg, 60 * std::cos(frequency * row.time_s), 60 * kTimes);
    EXPECT_LE(std::abs(row.pilot_deg - last_deg), run.row_deg * (1 + 1e-9));
    last_deg = row.pilot_deg;
  }
}

// x'' + (c/I) x' + w^2 x = 0: flat for the first time when tan(w_d t) = -w_d / g.
TEST_F(Oscillator, IsDampedAsOneIs) {
  const double decay = 0.2 * frequency, damped = std::sqrt(0.96) * frequency;
  options.joints.damping_n_mm_s_per_mm = 2 * decay * inertia / kAlong_mm;
  EXPECT_NEAR(released().last().time_s, (kPi - std::atan(damped / decay)) / damped,
              kTimes / frequency);
  run.swings = 100;
  const Deployment deployment = released();
  EXPECT_EQ(deployment.outcome, Outcome::flat);
  // When the amplitude has fallen to what is called flat.
  EXPECT_NEAR(deployment.last().time_s * decay, std::log(60 / run.flat_deg), 0.5);
}

// So much damping that it only creeps: x - h = A exp(-s t), s the slow root, up to where friction
// holds it, at h. In few steps, though the fast root is four million times the slow one.
// A stop gives back a share of the speed: turns are that share of the angle before, half periods
// apart.
TEST_F(Oscillator, BouncesOffAStop) {
  run.restitution = 0.5;
  const Deployment deployment = released();
  EXPECT_EQ(deployment.outcome, Outcome::flat);
  double angle_deg = 60, time_s = -kPi / 2 / frequency;
  int turns = 0, flats = 0;
  for (const Deployment::Row& row : deployment.rows) {
    if (row.event == Deployment::Event::turn) {
      ++turns;
      angle_deg /= 2;
      EXPECT_NEAR(row.pilot_deg, angle_deg, 60 * kTimes);
    } else if (row.event == Deployment::Event::flat) {
      ++flats;
      time_s += kPi / frequency;
      EXPECT_NEAR(row.time_s, time_s, kTimes * time_s);
      EXPECT_NEAR(row.kinetic_n_mm, stiffness / 2 * std::pow(angle_deg * kRadPerDeg, 2),
                  10 * kTimes * row.kinetic_n_mm);
    }
  }
  // 60, 30, ... 0.94 degrees; 0.47 is as good as flat.
  EXPECT_EQ(turns, 6);
  EXPECT_EQ(flats, 7);
  EXPECT_EQ(deployment.bounces, 6);
  run.restitution = 0;
  EXPECT_EQ(released().bounces, 0);
  EXPECT_EQ(released().outcome, Outcome::flat);
}

// Weight that presses on the stop does not take it through, nor does weight that lifts it off.
TEST_F(Oscillator, RestsOnAStopUnderItsWeight) {
  run.restitution = 0.5;
  run.time_limit_s = 20;
  options.joints.friction_n_mm_per_mm = 0.0002;
  int pressed = 0;
  for (const double g : {-9806.65, 9806.65}) {
    options.held = HeldPanel{0, {0, 0, g}};
    const EnergyModel weighed = sheet(options);
    std::vector<double> wells_x;
    for (const Equilibrium& at : find_equilibria(weighed)) {
      if (at.is_well) wells_x.push_back(at.x);
    }
    const Deployment deployment = deploy(weighed, wells_x, run);
    for (const Deployment::Row& row : deployment.rows) EXPECT_GE(row.pilot_deg, -1e-6) << g;
    const bool is_pressed = weighed.at(0.01).slope > weighed.at(0).friction;
    EXPECT_EQ(deployment.outcome == Outcome::flat, is_pressed) << g;
    pressed += is_pressed;
  }
  EXPECT_EQ(pressed, 1);
}

// With dry friction each way up ends where the energy after the bounce is spent, and nowhere
// before.
TEST_F(Oscillator, BouncesAgainstFriction) {
  run.restitution = 0.9;
  options.joints.friction_n_mm_per_mm = 0.0005;
  const double friction = options.joints.friction_n_mm_per_mm * kAlong_mm;
  const Deployment deployment = released();
  EXPECT_EQ(deployment.outcome, Outcome::flat);
  double angle = 60 * kRadPerDeg;
  int turns = 0;
  for (const Deployment::Row& row : deployment.rows) {
    if (row.event != Deployment::Event::turn) continue;
    ++turns;
    const double up = 0.81 * (stiffness / 2 * angle * angle - friction * angle);
    angle = (std::sqrt(friction * friction + 2 * stiffness * up) - friction) / stiffness;
    EXPECT_NEAR(row.pilot_deg * kRadPerDeg, angle, 1e-6 * angle);
  }
  EXPECT_GE(turns, 3);
  EXPECT_LE(deployment.last().pilot_deg * kRadPerDeg, friction / stiffness * (1 + 1e-9));
}

// Let go at rest with damping ratio z it passes flat with 60 w exp(-z (pi - acos z) / sqrt(1 -
// z^2)) degrees a second; it does not where that is the speed of half a degree's energy.
TEST_F(Oscillator, HasALeastDamping) {
  const auto least = least_damping([&](double damping) {
    options.joints.damping_n_mm_s_per_mm = damping;
    return released();
  });
  ASSERT_TRUE(least);
  double low = 0.1, high = 0.999;
  for (int k = 0; k < 60; ++k) {
    const double z = (low + high) / 2;
    const double passes_deg = 60 * std::exp(-z * (kPi - std::acos(z)) / std::sqrt(1 - z * z));
    (passes_deg > run.flat_deg ? low : high) = z;
  }
  const double critical = 2 * std::sqrt(stiffness * inertia) / kAlong_mm;
  EXPECT_NEAR(least->damping_n_mm_s_per_mm / (low * critical), 1, 2 * kDampingWithin);
  EXPECT_GT(least->time_s, kPi / 2 / frequency);
  // Held by friction it needs none.
  options.joints.friction_n_mm_per_mm = 1;
  EXPECT_FALSE(least_damping([&](double damping) {
    options.joints.damping_n_mm_s_per_mm = damping;
    return released();
  }));
}

TEST_F(Oscillator, CreepsToWhereFrictionHoldsIt) {
  const double held_deg = 7, decay = 1000 * frequency;
  options.joints.friction_n_mm_per_mm = stiffness * held_deg * kRadPerDeg / kAlong_mm;
  options.joints.damping_n_mm_s_per_mm = 2 * decay * inertia / kAlong_mm;
  run.time_limit_s = 1e5 / frequency;
  const Deployment creep = released();
  EXPECT_EQ(creep.outcome, Outcome::stalled);
  EXPECT_LT(creep.steps, 2000);
  EXPECT_NEAR(creep.last().pilot_deg, held_deg, 1e-4);
  const double root = std::sqrt(decay * decay - frequency * frequency);
  const double slow = frequency * frequency / (decay + root);
  const double from_deg = (60 - held_deg) * (decay + root) / (2 * root);
  for (const Deployment::Row& row : creep.rows) {
    if (row.time_s * decay < 50) continue;  // by then the fast root has gone
    EXPECT_NEAR(row.pilot_deg, held_deg + from_deg * std::exp(-slow * row.time_s), 60 * kTimes);
  }
}

// Coulomb: every half swing is shorter by twice the friction over the stiffness, until it holds.
TEST_F(Oscillator, IsHeldByDryFriction) {
  const double falls_deg = 7;
  options.joints.friction_n_mm_per_mm = stiffness * falls_deg * kRadPerDeg / kAlong_mm;
  const Deployment first = released();
  EXPECT_NEAR(first.last().time_s, std::acos(-falls_deg / (60 - falls_deg)) / frequency,
              kTimes / frequency);
  run.swings = 100;
  const Deployment all = released();
  EXPECT_EQ(all.outcome, Outcome::stalled);
  EXPECT_EQ(all.turns, 4);
  EXPECT_NEAR(all.last().pilot_deg, 60 - 8 * falls_deg, 1e-6);
  const FrictionLimits limits = find_friction_limits(sheet(options), 60);
  EXPECT_NEAR(limits.static_stall_deg, falls_deg, 1e-9);
  // Half of the stiffness times the angle, at flat; springs drive nothing here.
  EXPECT_NEAR(*limits.critical_n_mm_per_mm,
              options.joints.stiffness_n_mm_per_mm * 60 * kRadPerDeg / 2, 1e-12);
  EXPECT_NEAR(limits.critical_deg, 0, 1e-9);
}

TEST_F(Oscillator, WeightAndHeldHinge) {
  constexpr double kGravity = 9806.65;
  // Along the crease: what hangs on the hinge, with an arm of half a panel.
  options.held->gravity_mm_per_s2 = {0, -kGravity, 0};
  const Deployment deployment = released();
  const JointForces forces =
      find_joint_forces(sheet(options), *shape, base, deployment, {.in_motion = false});
  EXPECT_EQ(forces.reactions, 5);
  EXPECT_EQ(forces.rank, 5);
  ASSERT_GT(forces.pilot_deg.size(), 50u);
  for (Eigen::Index row = 0; row < forces.crease_force_n.rows(); ++row) {
    EXPECT_LT((forces.crease_force_n.row(row).transpose() - Eigen::Vector3d(0, mass * kGravity, 0))
                  .norm(),
              1e-12);
    EXPECT_NEAR(forces.crease_moment_n_mm.row(row).norm(), mass * kGravity * kPanel_mm / 2, 1e-9);
  }
  // Upwards: what it takes to be lifted by half a panel.
  options.held->gravity_mm_per_s2 = {0, 0, -kGravity};
  const EnergyModel lifted = sheet(options);
  const double x = kPi / 2;
  EXPECT_NEAR(lifted.all_else(x).energy - lifted.all_else(0).energy,
              stiffness * x * x / 2 + mass * kGravity * kPanel_mm / 2, 1e-9);
  EXPECT_NEAR(lifted.all_else(-x).energy - lifted.all_else(0).energy,
              stiffness * x * x / 2 - mass * kGravity * kPanel_mm / 2, 1e-9);
}

// Free in space both panels turn by half the angle, about centres that stay at one height.
struct FreePanels : TwoPanels, testing::Test {
  FreePanels() {
    options.joints.stiffness_n_mm_per_mm = 0.02;
    mass = options.plates.area_density() * kPanel_mm * kAlong_mm;
  }
  double generalised(double x) const {
    return mass * kPanel_mm * kPanel_mm * (std::pow(std::sin(x / 2), 2) / 8 + 1.0 / 24);
  }
  EnergyModel::Options options;
  double mass;
};

TEST_F(FreePanels, MassAndItsSlope) {
  const EnergyModel free = sheet(options);
  for (const double x : {-2.0, -0.3, 0.0, 1e-3, 0.5, 1.0, 2.0, 2.9}) {
    const EnergyAt here = free.at(x);
    EXPECT_NEAR(here.mass / generalised(x), 1, 1e-10) << x;
    EXPECT_NEAR(here.mass_slope, mass * kPanel_mm * kPanel_mm * std::sin(x) / 16,
                1e-8 * generalised(x));
  }
}

// On either panel: its mass times how its centre is accelerated towards the other one's.
TEST_F(FreePanels, ForceInTheHingeWhileItMoves) {
  const EnergyModel free = sheet(options);
  const Deployment deployment = deploy(free, {0.0}, {.from_deg = 150, .swings = 1});
  const JointForces forces = find_joint_forces(free, *shape, base, deployment);
  const double stiffness = options.joints.stiffness_n_mm_per_mm * kAlong_mm;
  Eigen::Index row = 0;
  for (const Deployment::Row& at : deployment.rows) {
    if (std::abs(at.pilot_deg) < 1) continue;
    const double slope = mass * kPanel_mm * kPanel_mm * std::sin(at.x) / 16, rate = at.x_rate;
    const double acceleration = (-slope * rate * rate / 2 - stiffness * at.x) / generalised(at.x);
    const double apart =
        -kPanel_mm / 2 *
        (std::sin(at.x / 2) / 2 * acceleration + std::cos(at.x / 2) / 4 * rate * rate);
    // Interpolated momenta: 1e-8 of what they are.
    EXPECT_NEAR(forces.crease_force_n.row(row).norm(), mass * std::abs(apart), 1e-7 * mass * 1e5)
        << at.pilot_deg;
    EXPECT_LT(forces.crease_moment_n_mm.row(row).norm(), 1e-6);
    ++row;
  }
  EXPECT_GT(row, 500);
}

// A single vertex of degree four: four trapezoids, placed by the closed form of their fold angles.
Eigen::Matrix3Xd single_vertex(const CreasePattern& sheet, const Mechanism& mechanism,
                               double pilot_rad) {
  Eigen::Matrix3Xd flat = Eigen::Matrix3Xd::Zero(3, 9), folded = flat;
  flat.topRows<2>() = sheet.vertices_mm;
  const Eigen::Vector3d centre = flat.col(4);
  const double cosine = 1 / std::sqrt(5.0);  // of the zigzag's sector angle, atan 2
  const double straight_rad = 2 * std::atan(cosine * std::tan(pilot_rad / 2));
  std::array<Eigen::Matrix3d, 4> turns{Eigen::Matrix3d::Identity()};
  std::array<bool, 4> placed{true};
  for (int round = 0; round < 3; ++round) {
    for (const Crease& crease : mechanism.creases) {
      const bool zigzag = std::abs(crease.a - crease.b) == 3;
      const Eigen::Vector3d axis = (flat.col(crease.b) - flat.col(crease.a)).normalized();
      const double angle =
          (mechanism.is_valley(crease) ? 1 : -1) * (zigzag ? pilot_rad : straight_rad);
      if (placed[crease.left] && !placed[crease.right]) {
        turns[crease.right] = turns[crease.left] * Eigen::AngleAxisd(-angle, axis);
        placed[crease.right] = true;
      } else if (placed[crease.right] && !placed[crease.left]) {
        turns[crease.left] = turns[crease.right] * Eigen::AngleAxisd(angle, axis);
        placed[crease.left] = true;
      }
    }
  }
  for (std::size_t f = 0; f < 4; ++f) {
    for (const int v : sheet.facets[f]) {
      folded.col(v) = centre + turns[f] * (flat.col(v) - centre);
    }
  }
  return folded;
}

TEST(SingleVertex, MassIsThatOfItsCoordinates) {
  const TestSheet vertex(2, 2);
  ASSERT_TRUE(vertex.base.holes.empty());
  const Model model(vertex.base);
  const auto way = way_of(model, vertex.base.sheet.vertices_mm);
  ASSERT_TRUE(way);
  const EnergyModel sheet(*way, model.shape(), vertex.base, {});
  for (const double pilot_deg : {5.0, 40.0, 90.0, 130.0, 170.0}) {
    const double x = way->x_of(pilot_deg), h = 1e-4;
    const auto folded = [&](double at) {
      return single_vertex(vertex.base.sheet, way->mechanism(), way->pilot_deg(at) * kRadPerDeg);
    };
    const double expected =
        mass_of_coordinates(vertex.base, Plates{}, folded(x - h), folded(x + h), 2 * h);
    // Differences of the second order: h^2 = 1e-8 of a third derivative.
    EXPECT_NEAR(sheet.at(x).mass / expected, 1, 1e-6) << pilot_deg;
  }
}

}  // namespace
}  // namespace misalign::solver
