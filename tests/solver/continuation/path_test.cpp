// The path: independent of the solver's steps, and its fold limit a true turning point.
#include "solver/kinematics/diagonals.hpp"
#include "solver/reference/arc_length.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

TEST(Path, StationsAreSamplesLooksAndSteps) {
  const TestSheet sheet(4, 4);
  PathPlanOptions options;
  options.sample_deg = 5;
  options.end_deg = 20;
  options.look_deg = 2.5;
  const PathPlan plan = sheet.plan(options);
  int samples = 0, looks = 0, steps = 0;
  double before = 0;
  for (const Station& station : plan.stations) {
    EXPECT_GT(station.pilot_deg, before + 0.4);  // no angle twice
    EXPECT_LE(station.pilot_deg, before + 1 + 1e-9);
    before = station.pilot_deg;
    if (station.sample > 0) {
      EXPECT_DOUBLE_EQ(station.pilot_deg, 5.0 * station.sample);
      EXPECT_TRUE(station.visit);
      ++samples;
    } else {
      ++(station.visit ? looks : steps);
    }
  }
  EXPECT_EQ(samples, 4);
  EXPECT_EQ(looks, 4);       // 2.5, 7.5, 12.5, 17.5
  EXPECT_EQ(steps, 20 - 4);  // whole degrees that are no sample
}

// A tenth of the step, or ten times the samples: the same curve. 1e-9 mm is 1e-11 panel widths,
// what closure to 1e-12 leaves of a length at these angles.
TEST(Path, LengthsAndVerdictDoNotDependOnTheSteps) {
  const Json table = golden("table1_odd.json");
  const TestSheet sheet(6, 6, table["holes"]);
  const FlatVertices vertices = sheet.shifted(table["displacements_mm"]);
  const auto usual = sheet.history(vertices);
  PathPlanOptions fine;
  fine.look_deg = 0.1;
  const auto finer = sheet.history(vertices, fine);
  EXPECT_EQ(finer.verdict.deploys_from_sample, usual.verdict.deploys_from_sample);
  EXPECT_EQ(finer.verdict.first_fault, usual.verdict.first_fault);
  // Located from different starting points, to 6e-8 degrees each.
  EXPECT_NEAR(finer.path.fold_limit_deg, usual.path.fold_limit_deg, 1e-6);
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < finer.stations.size(); ++k) {
    if (finer.stations[k].sample == 0) continue;
    const auto difference =
        finer.length_mm.row(static_cast<Eigen::Index>(k)) - usual.length_mm.row(row++);
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-9);
  }
  EXPECT_EQ(row, usual.length_mm.rows());
}

// Draw 424144 of search/campaigns/miura-4x4.json reaches 180 degrees, where its Jacobian is
// singular: a follower sees a limit point 1e-7 degrees below. Newton in steps of 0.02 degrees knows
// nothing of tangents, turns or factors in a fixed order.
TEST(Path, ReachesAStationWhereTheEquationsAreSingular) {
  const TestSheet sheet(4, 4);
  const FlatVertices vertices = sheet.shifted({{"A7", {0.4, 0.0}},
                                               {"A8", {-0.4, 0.0}},
                                               {"A9", {0.0, -0.4}},
                                               {"A13", {-0.4, 0.0}},
                                               {"A14", {-0.4, -0.4}},
                                               {"A17", {0.4, -0.4}},
                                               {"A18", {-0.4, 0.4}}});
  SheetGeometry<double> geometry;
  place(sheet.mechanism, vertices, geometry);
  Newton newton(sheet.mechanism);
  FoldState<double> state = sheet.folded(0.02);
  for (int k = 1; k <= 9000; ++k) {
    const FoldState<double> last = state;
    state.creases[sheet.mechanism.pilot] = half_angle_of_deg(0.02 * k);
    ASSERT_EQ(newton.correct(geometry, state).end, Newton::StopReason::converged) << 0.02 * k;
    ASSERT_LE(largest_half_sine(last, state), std::sin(0.5 * kRadPerDeg)) << "a jump";
  }
  std::vector<double> lengths(sheet.mechanism.diagonals.size());
  folded_lengths(sheet.mechanism, geometry, state, lengths.data());

  const FoldingHistory history = sheet.history(vertices);
  EXPECT_EQ(history.path.end, PathEnd::end_reached);
  EXPECT_EQ(history.path.fold_limit_deg, 180);
  EXPECT_EQ(history.verdict.deploys_from_sample, 180);
  EXPECT_LT(history.singular_value_min.back(), 1e-6);
  // Closed to 1e-12 where the equations are singular: states are known to the root of that.
  for (std::size_t d = 0; d < lengths.size(); ++d) {
    EXPECT_NEAR(history.length_mm(179, static_cast<Eigen::Index>(d)), lengths[d] * 80, 80e-6);
  }
}

// At a turning point the smallest singular value falls like the square root of the distance: this
// knows nothing of arc length or tangents. Samples close in on the limit found; a wrong limit would
// either leave stations unsolved below it or break the law.
TEST(Path, FoldLimitIsATurningPoint) {
  const Json table = golden("table1_odd.json");
  const TestSheet sheet(6, 6, table["holes"]);
  const FlatVertices vertices = sheet.shifted(table["displacements_mm"]);
  const double limit_deg = sheet.history(vertices).path.fold_limit_deg;

  const auto history_to = [&](double end_deg) {
    PathPlanOptions options;
    options.end_deg = end_deg;
    return sheet.history(vertices, options);
  };
  double last = 0;
  for (const double short_of : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const auto below = history_to(limit_deg - short_of);
    EXPECT_EQ(below.path.end, PathEnd::end_reached);
    const double sigma = below.singular_value_min.back();
    if (last > 0) {
      EXPECT_NEAR(last / sigma, std::sqrt(10.0), 0.1);
    }
    last = sigma;
  }
  const auto above = history_to(limit_deg + 1e-4);
  EXPECT_EQ(above.path.end, PathEnd::fold_limit);
  EXPECT_NEAR(above.path.fold_limit_deg, limit_deg, 1e-6);
}

// Two branches pass close by each other at 170.65 degrees (draw 53262 of miura-4x4, seed 1): the
// way along the arc must stay on its own. The sheet folds a crease past 180 degrees, it does not
// stall.
TEST(Path, StaysOnItsBranchWhereAnotherPassesCloseBy) {
  const TestSheet sheet(4, 4);
  const auto history = sheet.history(sheet.shifted(Json::parse(
      R"({"A13": [-0.4, 0.0], "A17": [0.4, -0.4], "A18": [-0.4, 0.0], "A19": [-0.4, 0.4], "A7": [0.4, 0.4], "A8": [-0.4, 0.0], "A9": [-0.4, -0.4]})")));
  EXPECT_EQ(history.verdict.first_fault, Fault::over_folded);
  EXPECT_EQ(history.verdict.deploys_from_sample, 170);
  EXPECT_EQ(history.path.end, PathEnd::fold_limit);
}

// The pilot turns at 176.836 and 176.591 degrees, and a little farther along the curve turns again
// and goes on (draws 271361 and 370864 of miura-4x4, seed 1): steps of a degree must not leap over
// both limit points. Short steps do not.
TEST(Path, TurnsWhereItWouldSoonTurnAgain) {
  const TestSheet sheet(4, 4);
  for (const char* displacements_mm :
       {R"({"A12": [0.4, 0.0], "A13": [0.0, -0.4], "A14": [-0.4, -0.4], "A17": [0.4, -0.4],
            "A18": [0.0, -0.4], "A19": [-0.4, 0.0], "A7": [0.4, -0.4]})",
        R"({"A12": [0.4, 0.0], "A13": [-0.4, 0.4], "A14": [0.4, 0.4], "A17": [0.4, 0.0],
            "A18": [0.4, -0.4], "A19": [0.4, 0.0], "A7": [0.4, -0.4]})"}) {
    const FlatVertices vertices = sheet.shifted(Json::parse(displacements_mm));
    PathPlanOptions short_steps;
    short_steps.sample_deg = 0.05;
    const PathResult fine = sheet.history(vertices, short_steps).path;
    const PathResult coarse = sheet.history(vertices).path;
    EXPECT_EQ(fine.end, PathEnd::fold_limit);
    EXPECT_EQ(coarse.end, PathEnd::fold_limit);
    EXPECT_NEAR(coarse.fold_limit_deg, fine.fold_limit_deg, 1e-6);
  }
}

TEST(Path, EndAskedForIsTheLimitReported) {
  const TestSheet sheet(6, 6);
  PathPlanOptions short_path;
  short_path.end_deg = 60.3;
  const auto history = sheet.history(sheet.shifted({{"A9", {0.4, 0.0}}}), short_path);
  EXPECT_EQ(history.path.end, PathEnd::end_reached);
  EXPECT_EQ(history.path.fold_limit_deg, 60.3);
  EXPECT_EQ(history.verdict.first_fault, Fault::none);
  EXPECT_EQ(history.verdict.deploys_from_sample, 60);
}

}  // namespace
}  // namespace misalign::solver
