// The deployment of a sheet whose A1 does not lie at the origin, against vertex coordinates and
// Newton's laws: nothing here knows a pose, a joint's rotation or a frame.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "solver/motion/deploy.hpp"
#include "tests/solver/coordinate_mass.hpp"
#include "tests/solver/families.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kReleased_deg = 36, kStiffness = 50, kApart_rad = 1e-4;

struct GradedSheet : testing::Test {
  GradedSheet() {
    const FoldingWay& way = *own.sheet.way();
    study = study_deployment(own.sheet, {}, {.from_deg = kReleased_deg}, JointForces::Options{});
    FoldState<double> state = way.stations().front().state;
    way.find_state(way.x_of(0.5), state);
    coordinates.emplace(family.base, vertices_mm,
                        own.model.shape().vertices_mm(way.geometry(), state), 0.5);
  }

  // Angles must go up from call to call.
  Matrix3Xd shape_mm(double pilot_deg) {
    EXPECT_TRUE(coordinates->fold_to(pilot_deg));
    return coordinates->points_mm();
  }
  // At this angle and half of kApart_rad on either side of it.
  struct Around {
    Matrix3Xd before_mm, here_mm, after_mm;
  };
  Around around(double pilot_deg) {
    const double beside_deg = kApart_rad / 2 / kRadPerDeg;
    const Matrix3Xd before_mm = shape_mm(pilot_deg - beside_deg), here_mm = shape_mm(pilot_deg);
    return {before_mm, here_mm, shape_mm(pilot_deg + beside_deg)};
  }
  double energy(const Matrix3Xd& shape_mm) const {
    double energy = 0;
    for (const Diagonal& d : family.mechanism.diagonals) {
      const double stretch_mm = (shape_mm.col(d.from) - shape_mm.col(d.to)).norm() -
                                (vertices_mm.col(d.from) - vertices_mm.col(d.to)).norm();
      energy += kStiffness / 2 * stretch_mm * stretch_mm;
    }
    return energy;
  }

  const CarriedFamily family{"miura-graded-6x6"};
  const FlatVertices vertices_mm = family.vertices(family.draws(1, kSeed), 0);
  const OwnSheet own{family.base, vertices_mm - family.base.sheet.vertices_mm};
  DeploymentStudy study;
  std::optional<VertexCoordinates> coordinates;
};

// Places on [0, 1] and their weights (Golub & Welsch 1969).
std::vector<std::pair<double, double>> gauss_legendre(int count) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(count, count);
  for (int k = 1; k < count; ++k)
    jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(jacobi);
  std::vector<std::pair<double, double>> rule;
  for (int k = 0; k < count; ++k) {
    rule.emplace_back((1 + solved.eigenvalues()(k)) / 2, std::pow(solved.eigenvectors()(0, k), 2));
  }
  return rule;
}

// mass / 2 (d rho / dt)^2 = E(from) - E; with rho = from (1 - u^2) nothing is singular at the
// start.
TEST_F(GradedSheet, IsFlatWhenItsCoordinatesSayItIs) {
  ASSERT_NE(vertices_mm.col(0).norm(), 0);
  auto rule = gauss_legendre(10);
  std::ranges::reverse(rule);
  const double from_rad = kReleased_deg * kRadPerDeg;
  std::vector<std::array<double, 3>> places;  // weight and u, mass, energy
  for (const auto& [u, weight] : rule) {
    const Around shapes = around(kReleased_deg * (1 - u * u));
    const double mass =
        mass_of_coordinates(family.base, Plates{}, shapes.before_mm, shapes.after_mm, kApart_rad);
    places.push_back({2 * from_rad * u * weight, mass, energy(shapes.here_mm)});
  }
  const double at_start = energy(shape_mm(kReleased_deg));
  double time_s = 0;
  for (const auto& [step, mass, here] : places) {
    time_s += step * std::sqrt(mass / 2 / (at_start - here));
  }
  EXPECT_NEAR(study.deploy_time_s().value() / time_s, 1, 1e-5);
}

// Of the two triangles of a panel: how momentum changes, and angular momentum about the origin.
std::pair<Vector3d, Vector3d> momentum_rates(const std::array<int, 4>& c, const Matrix3Xd& at_mm,
                                             const Matrix3Xd& acceleration) {
  Vector3d force = Vector3d::Zero(), moment = force;
  for (const std::array<int, 3>& triangle : {std::array{c[0], c[1], c[2]}, {c[0], c[2], c[3]}}) {
    const Vector3d one = at_mm.col(triangle[1]) - at_mm.col(triangle[0]),
                   other = at_mm.col(triangle[2]) - at_mm.col(triangle[0]);
    const double mass_t = Plates{}.area_density() * one.cross(other).norm() / 2;
    for (const int i : triangle) {
      force += mass_t / 3 * acceleration.col(i);
      for (const int k : triangle) {
        moment += (i == k ? 2 : 1) * mass_t / 12 *
                  Vector3d(at_mm.col(i)).cross(Vector3d(acceleration.col(k)));
      }
    }
  }
  return {force, moment};
}

// Turns a shape so that the first panel lies as it does flat.
Eigen::Isometry3d onto_first_panel(const CarriedFamily& family, const FlatVertices& vertices_mm,
                                   const Matrix3Xd& shape_mm) {
  const auto& c = family.base.sheet.facets[static_cast<std::size_t>(
      kept_facets(family.base.sheet, family.base.holes).front())];
  Matrix3Xd flat = Matrix3Xd::Zero(3, 4);
  flat.topRows<2>() = vertices_mm(Eigen::all, c);
  return Eigen::Isometry3d(Eigen::umeyama(Matrix3Xd(shape_mm(Eigen::all, c)), flat, false));
}

// At rest at the start each panel is accelerated as its springs and joints push it, force by force
// and moment by moment.
TEST_F(GradedSheet, JointForcesMoveEachPanel) {
  Around shapes = around(kReleased_deg);
  const CoordinateMotion motion =
      motion_of_coordinates(family.base, Plates{}, shapes.before_mm, shapes.after_mm, kApart_rad);
  const double slope = (energy(shapes.after_mm) - energy(shapes.before_mm)) / kApart_rad;
  const Eigen::Isometry3d place = onto_first_panel(family, vertices_mm, shapes.here_mm);
  const Matrix3Xd at_mm = place * shapes.here_mm,
                  acceleration = place.linear() * (-slope / motion.mass * motion.velocity_mm);

  const std::size_t facets = family.base.sheet.facets.size();
  std::vector<Vector3d> force(facets, Vector3d::Zero()), moment = force;
  double largest_n = 0;
  const auto push = [&](int facet, const Vector3d& on_mm, const Vector3d& by_n, int sign) {
    force[static_cast<std::size_t>(facet)] += sign * by_n;
    moment[static_cast<std::size_t>(facet)] += sign * on_mm.cross(by_n);
    largest_n = std::max(largest_n, by_n.norm());
  };
  const std::vector<int> kept = kept_facets(family.base.sheet, family.base.holes);
  for (const Diagonal& d : family.mechanism.diagonals) {
    const Vector3d apart_mm = at_mm.col(d.to) - at_mm.col(d.from);
    const double flat_mm = (vertices_mm.col(d.to) - vertices_mm.col(d.from)).norm();
    const Vector3d pull_n = kStiffness * (apart_mm.norm() - flat_mm) * apart_mm.normalized();
    for (const auto& [vertex, sign] : {std::pair(d.from, 1), {d.to, -1}}) {
      std::vector<int> sharing;
      for (const int f : kept) {
        if (std::ranges::count(family.base.sheet.facets[static_cast<std::size_t>(f)], vertex)) {
          sharing.push_back(f);
        }
      }
      for (const int f : sharing) {
        push(f, at_mm.col(vertex), pull_n / static_cast<double>(sharing.size()), sign);
      }
    }
  }
  for (Index k = 0; k < static_cast<Index>(family.mechanism.creases.size()); ++k) {
    const Crease& crease = family.mechanism.creases[static_cast<std::size_t>(k)];
    const Vector3d middle_mm = (at_mm.col(crease.a) + at_mm.col(crease.b)) / 2,
                   by_n = study.forces->crease_force_n.block<1, 3>(0, 3 * k).transpose(),
                   by_n_mm = study.forces->crease_moment_n_mm.block<1, 3>(0, 3 * k).transpose();
    for (const auto& [facet, sign] : {std::pair(crease.right, 1), {crease.left, -1}}) {
      push(facet, middle_mm, by_n, sign);
      moment[static_cast<std::size_t>(facet)] += sign * by_n_mm;
    }
  }
  for (Index k = 0; k < static_cast<Index>(family.mechanism.balls.size()); ++k) {
    const BallJoint& ball = family.mechanism.balls[static_cast<std::size_t>(k)];
    const Vector3d by_n = study.forces->ball_force_n.block<1, 3>(0, 3 * k).transpose();
    push(ball.to_facet, at_mm.col(ball.vertex), by_n, 1);
    push(ball.from_facet, at_mm.col(ball.vertex), by_n, -1);
  }

  const double size_mm = family.base.sheet.panel_width_mm;
  ASSERT_GT(largest_n, 1);
  for (const int f : kept) {
    const auto [force_n, moment_n_mm] =
        momentum_rates(family.base.sheet.facets[static_cast<std::size_t>(f)], at_mm, acceleration);
    // Differences over kApart_rad: its square.
    EXPECT_LT((force[static_cast<std::size_t>(f)] - force_n).norm(), 1e-5 * largest_n) << f;
    EXPECT_LT((moment[static_cast<std::size_t>(f)] - moment_n_mm).norm(),
              1e-5 * largest_n * size_mm * 6)
        << f;
  }
}

}  // namespace
}  // namespace misalign::solver
