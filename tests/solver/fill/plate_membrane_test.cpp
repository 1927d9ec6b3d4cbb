// Plates of folded sheets against membranes of finite elements, and their forces on the edges.
// Whole tables: tests/bench/rubber (results/rubber.md).
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "solver/fill/edge_forces.hpp"
#include "tests/solver/fill/membrane.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kShear_n_per_mm = 0.5;  // N/mm

// Corners of a hole from the first end of its first diagonal on.
std::array<int, 4> corners_of(const Mechanism& mechanism, int hole) {
  const Diagonal &one = mechanism.diagonals[static_cast<std::size_t>(2 * hole)],
                 &other = mechanism.diagonals[static_cast<std::size_t>(2 * hole + 1)];
  return {one.from, other.from, one.to, other.to};
}

HoleShape shape_of_hole(const HoleCorners& at_mm) {
  const Vector3d first = at_mm.col(2) - at_mm.col(0), second = at_mm.col(3) - at_mm.col(1);
  return {first.squaredNorm(), second.squaredNorm(), first.dot(second)};
}

struct Table1Plates : testing::Test {
  HoleCorners flat(int hole) const {
    HoleCorners at_mm = HoleCorners::Zero();
    at_mm.topRows<2>() = vertices_mm(Eigen::all, corners_of(sheet.mechanism, hole));
    return at_mm;
  }
  HoleCorners folded(int hole, double deg) const {
    return own.sheet.at(deg).vertices_mm(Eigen::all, corners_of(sheet.mechanism, hole));
  }
  HoleEnergy plate(int hole, double stretch, const HoleCorners& at_mm) const {
    const HoleShape now = shape_of_hole(at_mm);
    return PlateLaw(kShear_n_per_mm, shape_of_hole(flat(hole) / stretch))
        .at({std::sqrt(now.first_mm2), std::sqrt(now.second_mm2)}, now.product_mm2);
  }

  const TestSheet sheet{6, 6};
  const FlatVertices vertices_mm = sheet.shifted(golden("table1_odd.json")["displacements_mm"]);
  const OwnSheet own{sheet.base, vertices_mm - sheet.base.sheet.vertices_mm};
};

// Energies above those of the flat sheet, where the mean deformation is exact.
TEST_F(Table1Plates, EnergiesAreThoseOfMembranes) {
  for (const double stretch : {1.0, 1.1}) {
    for (const double deg : {36.0, 120.0}) {
      double closed = 0, elements = 0;
      for (int h = 0; h < 8; ++h) {
        const Membrane membrane(kShear_n_per_mm, flat(h).topRows<2>() / stretch,
                                Membrane::Wrinkles::relaxed);
        const auto solution = membrane.solve(folded(h, deg));
        EXPECT_LT(solution.unbalanced_n, 1e-4) << h;
        const double at_flat = plate(h, stretch, flat(h)).n_mm;
        const double more = plate(h, stretch, folded(h, deg)).n_mm - at_flat;
        // Unstretched, five plates are tense and three wrinkled.
        if (stretch == 1) {
          EXPECT_NEAR(more / solution.energy_n_mm, 1, 0.03) << h;
        }
        elements += solution.energy_n_mm - at_flat;
        closed += more;
      }
      EXPECT_NEAR(closed / elements, 1, 0.03) << stretch << " at " << deg;
    }
  }
}

TEST_F(Table1Plates, EdgeForcesBalanceAndDoTheWork) {
  for (int h = 0; h < 8; ++h) {
    const HoleCorners at_mm = folded(h, 90);
    const HoleEnergy energy = plate(h, 1.1, at_mm);
    const auto forces_n = edge_forces_n(energy, at_mm);
    ASSERT_GT(forces_n.norm(), 1);
    Vector3d moment = Vector3d::Zero();
    for (int k = 0; k < 4; ++k) {
      const Vector3d middle_mm = (at_mm.col(k) + at_mm.col((k + 1) % 4)) / 2;
      moment += middle_mm.cross(Vector3d(forces_n.col(k)));
    }
    EXPECT_LT(forces_n.rowwise().sum().norm(), 1e-12 * forces_n.norm()) << h;
    EXPECT_LT(moment.norm(), 1e-12 * forces_n.norm() * at_mm.norm()) << h;
    // Each corner moved by itself: the edges' middles follow by half.
    for (int k = 0; k < 4; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        HoleCorners before_mm = at_mm, after_mm = at_mm;
        before_mm(axis, k) -= 1e-3;
        after_mm(axis, k) += 1e-3;
        const double slope = (plate(h, 1.1, after_mm).n_mm - plate(h, 1.1, before_mm).n_mm) / 2e-3;
        const double force_n = (forces_n(axis, k) + forces_n(axis, (k + 3) % 4)) / 2;
        EXPECT_NEAR(force_n, -slope, 1e-6 * forces_n.norm()) << h << " " << k;
      }
    }
  }
}

TEST_F(Table1Plates, CornerForcesAreReactionsOfMembranes) {
  for (const double stretch : {1.0, 1.1}) {
    for (int h = 0; h < 8; ++h) {
      const HoleCorners at_mm = folded(h, 90);
      const auto forces_n = edge_forces_n(plate(h, stretch, at_mm), at_mm);
      HoleCorners corner_n;
      for (int k = 0; k < 4; ++k)
        corner_n.col(k) = (forces_n.col(k) + forces_n.col((k + 3) % 4)) / 2;
      const Membrane membrane(kShear_n_per_mm, flat(h).topRows<2>() / stretch,
                              Membrane::Wrinkles::relaxed);
      const HoleCorners reactions_n = membrane.solve(at_mm).corner_forces_n;
      EXPECT_LT((corner_n - reactions_n).norm(), 0.05 * reactions_n.norm()) << stretch << " " << h;
    }
  }
}

}  // namespace
}  // namespace misalign::solver
