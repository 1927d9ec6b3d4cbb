// Proofs of wells, beside the equilibria that root finding shows on the way; a sweep of vertex
// coordinates is stress/wells.cpp.
#include "solver/certificate/energy_wells.hpp"

#include <gtest/gtest.h>

#include "../blocks.hpp"
#include "solver/certificate/simple_roots.hpp"
#include "solver/motion/equilibria.hpp"

namespace misalign::solver {
namespace {

// The product of (s - root) over all roots, times 1 + s / 4.
PathModel with_roots(const std::vector<double>& roots, double radius) {
  PathModel f = PathModel::line(1, 0.25);
  for (const double root : roots) f = f * PathModel::line(-root, 1);
  f.radius = radius;
  return f;
}

TEST(IsolateRoots, FindsEachOnceWithItsSign) {
  const std::vector<double> roots = {-0.75, -0.1, -0.099, 0.3, 0.9999};
  const auto found = isolate_roots(with_roots(roots, 1e-12));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), roots.size());
  for (std::size_t k = 0; k < roots.size(); ++k) {
    EXPECT_LT(found->at(k).from, roots[k]);
    EXPECT_GT(found->at(k).to, roots[k]);
    EXPECT_EQ(found->at(k).sign_behind, k % 2 == 0 ? 1 : -1) << "it begins below 0";
  }
  EXPECT_TRUE(isolate_roots(with_roots({}, 0.5))->empty());
}

TEST(IsolateRoots, RefusesWhatIsNotProven) {
  EXPECT_FALSE(isolate_roots(with_roots({0.2, 0.2}, 0))) << "a double root";
  EXPECT_FALSE(isolate_roots(with_roots({1}, 1e-12))) << "a root at the end";
  // A function this near to s may fall where it is below 0.6: R / (1 - |s|) exceeds 1 from 0.4 on.
  EXPECT_FALSE(isolate_roots(with_roots({0}, 0.6)));
  EXPECT_TRUE(isolate_roots(with_roots({0}, 0.1)));
}

// A drawn sheet of 4 x 4 panels.
struct WellSheet {
  explicit WellSheet(unsigned seed, double amplitude_mm = 0.4)
      : sheet(solver, drawn.vertices(drawn.draws(1, seed, amplitude_mm), 0) -
                          drawn.base.sheet.vertices_mm) {}
  double length_mm(std::size_t d, const Eigen::Matrix3Xd& at_mm) const {
    const Diagonal& diagonal = drawn.mechanism.diagonals[d];
    return (at_mm.col(diagonal.to) - at_mm.col(diagonal.from)).norm();
  }
  const DrawableSheet drawn{4, 4};
  const Model model{drawn.base, drawn.shifted_vertices, {}, 0};
  SheetSolver solver{model};
  const Sheet sheet;
};

// Springs relaxed at one angle, flat, at several angles, preloaded ones; and plates.
std::vector<Fill> fillings() {
  Springs at_60, flat, mixed, preloaded;
  at_60.rest_deg = mixed.rest_deg = 60;
  mixed.other_rests_deg = {{0, 120}, {2, 20}, {3, 140}};
  preloaded.preload.each_n = 3;
  RubberPlates plates;
  plates.prestretch = 1.2;
  return {at_60, flat, mixed, preloaded, plates};
}

TEST(EnergyWells, AreTheEquilibriaOfTheWay) {
  int points = 0, tops = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const WellSheet drawn(seed);
    for (const Fill& fill : fillings()) {
      const auto wells = prove_wells(drawn.sheet, fill, 150);
      ASSERT_TRUE(wells);
      ASSERT_TRUE(wells->flat) << seed;
      EnergyModel::Options options;
      options.fill = fill;
      std::vector<Equilibrium> known;
      for (const Equilibrium& at : find_equilibria(EnergyModel(drawn.sheet, options))) {
        if (at.pilot_deg < 0 || at.pilot_deg > wells->proven_deg) continue;
        if (at.pilot_deg > 0) {
          known.push_back(at);
        } else {
          EXPECT_EQ(at.is_well, wells->flat == Stationary::well) << seed;
          EXPECT_NEAR(at.energy_n_mm, wells->flat_energy.n_mm, 1e-9 * (1 + at.energy_n_mm));
        }
      }
      ASSERT_EQ(wells->points.size(), known.size()) << seed << ", " << fill.index();
      for (std::size_t k = 0; k < known.size(); ++k) {
        const StationaryPoint& point = wells->points[k];
        // The equilibria of the way are known to 1e-4 degrees.
        EXPECT_GT(known[k].pilot_deg, point.from_deg - 1e-4);
        EXPECT_LT(known[k].pilot_deg, point.to_deg + 1e-4);
        EXPECT_LE(point.from_deg, point.to_deg);
        EXPECT_LE(point.to_deg - point.from_deg, 0.01);
        EXPECT_EQ(point.kind == Stationary::well, known[k].is_well);
        EXPECT_NEAR(point.energy.n_mm, known[k].energy_n_mm, 1e-7 * (1 + known[k].energy_n_mm));
        tops += point.kind == Stationary::top;
      }
      points += static_cast<int>(known.size());
    }
  }
  EXPECT_GT(points, 10);
  EXPECT_GT(tops, 2);
}

// All springs are relaxed at 60 degrees: a well without energy, in the units of vertex coordinates.
TEST(EnergyWells, HoldTheAngleWhereSpringsAreRelaxed) {
  const WellSheet drawn(1);
  const auto wells = prove_wells(drawn.sheet, fillings().front(), 100);
  ASSERT_TRUE(wells);
  EXPECT_EQ(wells->end, CertificateEnd::to_the_end);
  EXPECT_EQ(wells->proven_deg, 100);
  EXPECT_EQ(wells->flat, Stationary::top);
  ASSERT_EQ(wells->points.size(), 1u);
  const StationaryPoint& well = wells->points.front();
  EXPECT_EQ(well.kind, Stationary::well);
  // The free lengths are those of the way's polynomials at 60 degrees, whose errors move the well.
  EXPECT_LT(well.from_deg, 60 + 1e-6);
  EXPECT_GT(well.to_deg, 60 - 1e-6);
  EXPECT_LE(std::abs(well.energy.n_mm), well.energy.error_n_mm);
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, drawn.sheet.vertices_mm().cols());
  flat_mm.topRows<2>() = drawn.sheet.vertices_mm();
  double flat_n_mm = 0;
  for (std::size_t d = 0; d < drawn.drawn.mechanism.diagonals.size(); ++d) {
    const double longer_mm =
        drawn.length_mm(d, flat_mm) - drawn.length_mm(d, drawn.sheet.at(60).vertices_mm);
    flat_n_mm += Springs{}.stiffness_n_per_mm / 2 * longer_mm * longer_mm;
  }
  EXPECT_NEAR(wells->flat_energy.n_mm, flat_n_mm, 1e-9 * flat_n_mm);
}

TEST(EnergyWells, EndWhereACreaseIsFoldedFlat) {
  const WellSheet drawn(kSeed + 13, 5);
  const auto wells = prove_wells(drawn.sheet, fillings().front(), 179);
  ASSERT_TRUE(wells);
  ASSERT_EQ(wells->end, CertificateEnd::over_folded);
  ASSERT_LT(wells->proven_deg, 178);
  // It happens within kClosing_deg; this crease turns less than a hundred times as fast as the
  // pilot.
  const Sheet::Pose& end = drawn.sheet.at(wells->proven_deg);
  EXPECT_NEAR(std::abs(end.fold_deg(wells->where)), 180, 100 * kClosing_deg);
}

TEST(EnergyWells, EndWherePlatesAreNotTense) {
  const WellSheet drawn(1, 5);
  RubberPlates slack;  // holes shrink by more than this pre-stretch
  slack.prestretch = 1.001;
  const auto wells = prove_wells(drawn.sheet, slack, 150);
  ASSERT_TRUE(wells);
  EXPECT_EQ(wells->end, CertificateEnd::unclear_slope);
  EXPECT_LT(wells->proven_deg, 150);
}

TEST(EnergyWells, RefuseFillingsWithoutAProof) {
  const WellSheet drawn(1);
  Springs beyond, wires, none;
  beyond.rest_deg = 180;
  wires.pull_only = true;
  none.stiffness_n_per_mm = 0;
  RubberPlates at_rest;
  at_rest.rest_deg = 60;
  for (const Fill& fill : {Fill(beyond), Fill(wires), Fill(none), Fill(at_rest), Fill(NoFill{})}) {
    EXPECT_NE(prove_wells(drawn.sheet, fill, 100).fault(), nullptr);
  }
  EXPECT_EQ(prove_wells(drawn.sheet, beyond, 100).fault()->name, "rest_deg");
  EXPECT_EQ(prove_wells(drawn.sheet, wires, 100).fault()->name, "fill");
}

}  // namespace
}  // namespace misalign::solver
