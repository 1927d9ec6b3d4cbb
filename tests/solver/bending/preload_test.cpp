// A force that is left in the springs at flat, against the energies of bent panels.
#include "solver/bending/preload.hpp"

#include "tests/solver/bending/bent.hpp"

namespace misalign::solver {
namespace {

using Eigen::VectorXd;

// Programs that share no code found of Table 1: 1 mm best with 0.05 N, none left at 0.10; 4 mm 3
// and 6; of 18 ways to leave flat eight or nine are unstable with any preload.
TEST_F(Bent, PreloadOfTable1) {
  const VectorXd all = sides_of_diagonals(*own.sheet.way());
  const PreloadAtFlat thin = *preload_at_flat(own.sheet, {}, 1, all),
                      thick = *preload_at_flat(own.sheet, {}, 4, all);
  EXPECT_NEAR(thin.best_n(), 0.05, 0.005);
  EXPECT_NEAR(thick.best_n(), 3, 0.3);
  const ElasticSheet sheet = panels();
  for (const double preload_n : {0.001, 0.05, 1.0}) {
    const FlatModes modes =
        find_flat_modes(sheet, springs(50, sheet.flat_lengths_mm() - preload_n / 50 * all));
    EXPECT_EQ(modes.rigid, 18);
    EXPECT_GE(modes.unstable, 8);
    EXPECT_LE(modes.unstable, 9);
  }
  EXPECT_EQ(find_flat_modes(sheet, springs(50, sheet.flat_lengths_mm())).unstable, 0);
}

// The rigid sheet's moment grows with the angle under preload, and the bent one's too.
TEST_F(Bent, PreloadMovesItOnNearFlat) {
  ReleaseOptions deploying;
  deploying.sheet.plates.thickness_mm = 4;
  const double without = bent(deploying).friction.static_n_mm_per_mm;
  deploying.sheet.springs().preload.each_n = 3;
  const BentPanels with = bent(deploying);
  EXPECT_GT(with.friction.static_n_mm_per_mm, 20 * without);
  const BentWay way(own.sheet, {}, 4, 1, 36, 16);
  const VectorXd all = sides_of_diagonals(*own.sheet.way());
  const BestPreload best = best_preload(way, VectorXd::Constant(all.size(), 50), 1,
                                        *preload_at_flat(own.sheet, {}, 4, all), all);
  EXPECT_GE(best.static_n_mm_per_mm, with.friction.static_n_mm_per_mm * (1 - 1e-6));
  deploying.sheet.springs().rest_deg = 20;
  EXPECT_EQ(bend_panels(own.sheet, deploying, {}).fault()->name, "preload_n");
}

// Springs on the diagonals that lengthen always pull, as wires do.
TEST_F(Bent, PreloadPullsWiresOneAHole) {
  ReleaseOptions deploying;
  deploying.sheet.plates.thickness_mm = 4;
  deploying.sheet.springs().preload.each_n = 1;
  deploying.sheet.springs().pull_only = true;
  EXPECT_EQ(bend_panels(own.sheet, deploying, {}).fault()->name, "preload_n");
  deploying.sheet.springs().on = SpringsOn::one_a_hole;
  const double of_wires = bent(deploying).friction.static_n_mm_per_mm;
  deploying.sheet.springs().pull_only = false;
  // Newton's method begins and ends elsewhere.
  EXPECT_NEAR(bent(deploying).friction.static_n_mm_per_mm / of_wires, 1, 1e-5);
  EXPECT_GT(of_wires, 0);
}

// Panels like rock: let go near flat it is there after a quarter of its period; also where springs
// have preloads of their own.
TEST_F(Bent, PreloadSwingsItAboutFlat) {
  const std::vector<Diagonal>& diagonals = own.sheet.mechanism().diagonals;
  const auto own_n = [&](std::size_t d, double n) {
    return Preload::OfOne{diagonals[d].to, diagonals[d].from, n};
  };
  for (const Preload& preload :
       {Preload{30, {}}, Preload{20, {own_n(0, 0), own_n(5, 60), own_n(10, 3)}}}) {
    ReleaseOptions deploying;
    deploying.from_deg = 1.5;
    deploying.sheet.springs().preload = preload;
    BentPanelsOptions rock;
    rock.material.e_gpa = 1e11;
    const BentPanels panels = *bend_panels(own.sheet, deploying, rock);
    const PreloadStudy found = *study_preload(own.sheet, deploying, panels);
    EXPECT_EQ(found.preload_n, preload.largest_n());
    const DeploymentStudy let_go = *deploy(own.sheet, deploying);
    // The springs' own stiffness adds k L2^2 rho^2 / 2 F L2 of it: half a per mille here; lengths
    // near flat are off L2 rho^2 by (1 degree / 3)^2.
    EXPECT_NEAR(4 * let_go.deploy_time_s().value() * found.frequency_hz, 1, 2e-3);
  }
}

}  // namespace
}  // namespace misalign::solver
