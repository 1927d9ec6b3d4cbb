// Histories of paths that the fixed order of elimination loses: dense matrices go on from there.
#include "tests/solver/families.hpp"

namespace misalign::solver {
namespace {

// The unshifted Miura-ori folds flat, where other branches cross. What dense matrices find from the
// first station on is what they find where they go on, and nothing is seen twice.
TEST(History, GoesOnDenselyFromWhereItWasLost) {
  const TestSheet sheet(6, 6);
  const Model model(sheet.base);
  double last_deg = 0;
  const StationVisitor visit = [&](const Station& station, const PathPoint& point) {
    EXPECT_GT(station.pilot_deg, last_deg);
    EXPECT_EQ(point.rates.size(), static_cast<std::size_t>(sheet.mechanism.unknowns));
    last_deg = station.pilot_deg;
  };
  const FoldingHistory found = record_history(model, sheet.base.sheet.vertices_mm, &visit),
                       expected = record_with_pivoting(model, sheet.base.sheet.vertices_mm);
  EXPECT_EQ(decision(found.verdict), decision(expected.verdict));
  EXPECT_EQ(found.path.end, expected.path.end);
  EXPECT_NEAR(found.path.fold_limit_deg, expected.path.fold_limit_deg, 1e-6);
  ASSERT_EQ(found.stations.size(), expected.stations.size());
  EXPECT_EQ(last_deg, found.stations.back().pilot_deg);
  EXPECT_LT((found.length_mm - expected.length_mm).cwiseAbs().maxCoeff(), 1e-8);
  // At 180 degrees itself the Jacobian is singular: there only lengths are good.
  const Eigen::MatrixXd off_deg = found.fold_angle_deg - expected.fold_angle_deg;
  EXPECT_LT(off_deg.topRows(off_deg.rows() - 1).cwiseAbs().maxCoeff(), 1e-8);
}

}  // namespace
}  // namespace misalign::solver
