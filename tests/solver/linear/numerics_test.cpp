// Newton, dense factors and the smallest singular value, against Eigen's SVD.
#include <Eigen/SVD>

#include "solver/linear/newton.hpp"
#include "solver/linear/singular_value.hpp"
#include "solver/reference/reference.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

TEST(Numerics, FactorsSolveBothWaysAndKnowTheSign) {
  const Eigen::Index n = 37;
  srand(11);
  DenseSolve factors(n);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(n, n);
    const Eigen::VectorXd rhs = Eigen::VectorXd::Random(n);
    factors.factorize(matrix);
    EXPECT_LE((matrix * factors.solve(rhs) - rhs).norm(), 1e-10);
    EXPECT_LE((matrix.transpose() * factors.solve_transposed(rhs) - rhs).norm(), 1e-10);
    EXPECT_EQ(factors.determinant_sign(), matrix.determinant() > 0 ? 1 : -1);
  }
}

// model.md: near flat the smallest singular value goes like rho, 2.6e-4 at 1 degree.
TEST(Numerics, SmallestSingularValueOfTheBaseNearFlat) {
  const TestSheet sheet(6, 6);
  ClosureSystem system(sheet.mechanism);
  PivotedJacobian factors(system);
  SmallestSingularValue<double> smallest(sheet.mechanism.equations);
  const auto at = [&](double pilot_deg) {
    system.evaluate(sheet.geometry, sheet.folded(pilot_deg));
    factors.factorize();
    return smallest.of(factors);
  };
  EXPECT_NEAR(at(1), 2.6e-4, 0.1e-4);
  EXPECT_NEAR(at(0.1) / at(1), 0.1, 0.001);
}

TEST(Numerics, SmallestSingularValueAlongAPathEqualsSvd) {
  const Json table = golden("table1_even.json");
  const TestSheet sheet(6, 6, table["holes"]);
  const FlatVertices vertices = sheet.shifted(table["displacements_mm"]);
  SheetGeometry<double> geometry;
  place(sheet.mechanism, vertices, geometry);
  const PathPlan plan = sheet.plan();
  const auto history = sheet.history(vertices);
  ClosureSystem system(sheet.mechanism);
  PathTracker tracker(sheet.mechanism);
  std::size_t row = 0;
  tracker.follow(geometry, plan, [&](const Station&, const FoldState<double>& state) {
    system.evaluate(geometry, state);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(
        system.jacobian().leftCols(sheet.mechanism.equations));
    const double expected = svd.singularValues().minCoeff();
    EXPECT_NEAR(history.singular_value_min[row] / expected, 1, 1e-6) << "station " << row;
    ++row;
    return row < history.stations.size();
  });
  EXPECT_EQ(row, history.stations.size());
}

// At 180 degrees, where the pivots of the fixed order vanish: every tenth sheet of 4 x 4 gets
// there.
TEST(Numerics, SmallestSingularValueAtTheFoldedEnd) {
  const DrawableSheet sheets(4, 4);
  const Model model = sheets.with_threshold(1);
  const ShiftBlock block = sheets.draws(60, kSeed);
  const auto batch = make_batch(available_instruction_sets().back(), model);
  const auto& histories = batch->record(block);
  ClosureSystem system(model.mechanism());
  PathTracker tracker(model.mechanism());
  SheetGeometry<double> geometry;
  int reached = 0;
  for (int i = 0; i < block.sheets; ++i) {
    if (histories[i].path.end != PathEnd::end_reached) continue;
    ++reached;
    place(model.mechanism(), sheets.vertices(block, i), geometry);
    double expected = 0;
    tracker.follow(geometry, model.path(),
                   [&](const Station& station, const FoldState<double>& state) {
                     if (station.pilot_deg < 180) return true;
                     system.evaluate(geometry, state);
                     const Eigen::JacobiSVD<Eigen::MatrixXd> svd(
                         system.jacobian().leftCols(model.mechanism().equations));
                     expected = svd.singularValues().minCoeff();
                     return true;
                   });
    EXPECT_NEAR(histories[i].singular_value_min.back() / expected, 1, 1e-5) << "sheet " << i;
    EXPECT_LE(histories[i].open_by.back(), Newton::Options{}.closure_tolerance) << "sheet " << i;
  }
  EXPECT_GT(reached, 3);
}

TEST(Numerics, NewtonTellsHowItEnded) {
  const TestSheet sheet(6, 6);
  Newton newton(sheet.mechanism);
  auto state = sheet.folded(50);
  state.creases[sheet.mechanism.pilot] = half_angle_of_deg(51);
  const Newton::Result good = newton.correct(sheet.geometry, state);
  EXPECT_EQ(good.end, Newton::StopReason::converged);
  EXPECT_LE(good.open_by, 1e-12);
  EXPECT_LE(good.iterations, 5);

  // One correction does not do from 1 degree away: both sides of max_iterations.
  Newton impatient(sheet.mechanism, {1e-12, 1});
  state = sheet.folded(50);
  state.creases[sheet.mechanism.pilot] = half_angle_of_deg(51);
  EXPECT_EQ(impatient.correct(sheet.geometry, state).end, Newton::StopReason::too_many_steps);

  state = sheet.folded(50);
  state.creases[0].c = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(newton.correct(sheet.geometry, state).end, Newton::StopReason::not_a_number);
}

}  // namespace
}  // namespace misalign::solver
