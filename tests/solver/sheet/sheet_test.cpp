// What a sheet remembers: what the functions that follow its path anew find, each found once.
#include "solver/sheet/sheet.hpp"

#include <malloc.h>

#include <random>

#include "solver/records/record_sheet.hpp"
#include "solver/sheet/path_source.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/families.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/record_path.hpp"

namespace misalign::solver {
namespace {

struct Table1Sheet : testing::Test {
  const TestSheet sheet{6, 6};
  const OwnSheet own{sheet.base, sheet.shifted(golden("table1_odd.json")["displacements_mm"]) -
                                     sheet.base.sheet.vertices_mm};
  const Sheet& found = own.sheet;
  const PathSource::Followed& followed = own.solver.paths().followed();
};

void expect_same(const FoldingHistory& found, const FoldingHistory& expected) {
  EXPECT_EQ(decision(found.verdict), decision(expected.verdict));
  EXPECT_EQ(found.path.fold_limit_deg, expected.path.fold_limit_deg);
  EXPECT_EQ(found.length_mm, expected.length_mm);
  EXPECT_EQ(found.slope_mm_per_deg, expected.slope_mm_per_deg);
  EXPECT_EQ(found.fold_angle_deg, expected.fold_angle_deg);
  EXPECT_EQ(found.singular_value_min, expected.singular_value_min);
}

void expect_same(const PathRecord& found, const PathRecord& expected) {
  EXPECT_EQ(decision(found.verdict), decision(expected.verdict));
  EXPECT_EQ(found.lengths, expected.lengths);
  EXPECT_EQ(found.extremes.least_slope, expected.extremes.least_slope);
  EXPECT_EQ(found.singular_value_min, expected.singular_value_min);
}

TEST_F(Table1Sheet, FollowsNothingBeforeItIsAsked) {
  EXPECT_EQ(found.vertices_mm(), sheet.base.sheet.vertices_mm + found.shifts_mm());
  EXPECT_EQ(found.panels().facets.size(), 28u);
  EXPECT_EQ(followed.as_functions + followed.closely, 0);
}

TEST_F(Table1Sheet, FindsEachOnce) {
  for (int times = 0; times < 3; ++times) {
    EXPECT_EQ(found.deploys_from_deg(), 156);
    EXPECT_EQ(followed.as_functions, 1);
    EXPECT_EQ(followed.closely, 0) << "D needs no close steps";
  }
  for (int times = 0; times < 3; ++times) {
    EXPECT_EQ(found.shapes_mm().size(), found.history().stations.size());
    EXPECT_EQ(found.span_slope_mm_per_deg().size(), found.states().size());
    ASSERT_TRUE(found.metrics());
    EXPECT_EQ(found.metrics(), found.metrics());
    EXPECT_EQ(followed.as_functions, 1);
    EXPECT_EQ(followed.closely, 1);
  }
  for (int times = 0; times < 3; ++times) {
    ASSERT_TRUE(found.way());
    EXPECT_EQ(found.way(), found.way(kWayStations));
    EXPECT_EQ(found.way()->stations().size(), static_cast<std::size_t>(kWayStations));
    EXPECT_EQ(found.way(120)->stations().size(), 120u);
    EXPECT_EQ(followed.as_functions, 2) << "one outline for all ways";
    EXPECT_EQ(followed.closely, 3);
  }
}

// Rigid panels, and the angles and lengths that close steps find at a sample.
TEST_F(Table1Sheet, HasAPoseAtAnAngle) {
  const Eigen::Matrix3Xd& at_mm = found.at(36).vertices_mm;
  for (const std::array<int, 4>& corners : found.panels().corners) {
    for (const int a : corners) {
      for (const int b : corners) {
        EXPECT_NEAR((at_mm.col(a) - at_mm.col(b)).norm(),
                    (found.point_mm(a) - found.point_mm(b)).norm(), 1e-9);
      }
    }
  }
  EXPECT_TRUE(found.at(36).is_closed);
  EXPECT_EQ(&found.at(36), &found.at(36));
  const auto& stations = found.history().stations;
  ASSERT_EQ(stations[35].sample, 36);
  const Eigen::VectorXd fold_deg = found.history().fold_angle_deg.row(35),
                        length_mm = found.history().length_mm.row(35);
  EXPECT_LT((found.at(36).fold_deg - fold_deg).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((found.at(36).length_mm - length_mm).cwiseAbs().maxCoeff(), 1e-8);
  int d = 0;
  for (const Diagonal& diagonal : found.mechanism().diagonals) {
    EXPECT_NEAR((at_mm.col(diagonal.from) - at_mm.col(diagonal.to)).norm(), length_mm(d++), 1e-8);
  }
  EXPECT_EQ(found.row_at(36), 35);
  EXPECT_EQ(found.row_at(36.5), std::nullopt);
}

// A fold angle is the angle between the normals of the crease's two panels; vertices are known to
// rounding, and no crease of 36 degrees is near 0 or 180, where the angle would be less sure.
TEST_F(Table1Sheet, FoldsByTheAnglesBetweenItsPanels) {
  const Sheet::Pose& pose = found.at(36);
  const auto has = [](const std::array<int, 4>& corners, int vertex) {
    return std::ranges::find(corners, vertex) != corners.end();
  };
  int compared = 0;
  for (const Crease& crease : found.mechanism().creases) {
    std::vector<Eigen::Vector3d> normals;
    for (const std::array<int, 4>& corners : found.panels().corners) {
      if (!has(corners, crease.a) || !has(corners, crease.b)) continue;
      const auto side_mm = [&](int corner) -> Eigen::Vector3d {
        return pose.vertices_mm.col(corners[static_cast<std::size_t>(corner)]) -
               pose.vertices_mm.col(corners[0]);
      };
      normals.push_back(side_mm(1).cross(side_mm(3)).normalized());
    }
    ASSERT_EQ(normals.size(), 2u);
    const double angle_deg =
        std::atan2(normals[0].cross(normals[1]).norm(), normals[0].dot(normals[1])) / kRadPerDeg;
    EXPECT_NEAR(std::abs(pose.fold_deg(compared++)), angle_deg, 1e-9);
  }
  EXPECT_EQ(compared, pose.fold_deg.size());
}

TEST_F(Table1Sheet, FindsWhatIsFoundAnew) {
  expect_same(found.record(), record_path(own.model, found.vertices_mm()));
  const FoldingHistory history = record_history(own.model, found.vertices_mm());
  expect_same(found.history(), history);
  // Its metrics are those of every sample, but for what happens between them.
  PathRecord record = record_of(history, own.model.mechanism());
  record.extremes = found.record().extremes;
  const Metrics metrics = measure(own.model, found.vertices_mm(), record);
  EXPECT_EQ(found.metrics()->elongation, metrics.elongation);
  EXPECT_EQ(found.metrics()->singular_value_min, metrics.singular_value_min);
  EXPECT_EQ(found.metrics()->slope_between_min_mm_per_deg, metrics.slope_between_min_mm_per_deg);
}

// One after another by one solver, in whatever order they are asked: as each alone.
TEST(Sheet, KnowsNothingOfOthersOfItsSolver) {
  const DrawableSheet sheets(4, 4);
  const ShiftBlock block = sheets.draws(12, kSeed);
  const Model model(sheets.base);
  SheetSolver solver(model);
  std::vector<Sheet> all;
  for (int i = 0; i < block.sheets; ++i) {
    all.emplace_back(solver, sheets.vertices(block, i) - sheets.base.sheet.vertices_mm);
  }
  for (const Sheet& sheet : all) sheet.way();
  for (const Sheet& sheet : all) sheet.history();
  int deploying = 0;
  for (const Sheet& sheet : all) {
    expect_same(sheet.record(), record_path(model, sheet.vertices_mm()));
    expect_same(sheet.history(), record_history(model, sheet.vertices_mm()));
    const auto alone = way_of(model, sheet.vertices_mm());
    ASSERT_EQ(alone.has_value(), sheet.way() != nullptr);
    if (alone) {
      EXPECT_EQ(alone->end(), sheet.way()->end());
    }
    EXPECT_EQ(sheet.metrics() != nullptr, sheet.verdict().deploys_from_sample > 0);
    EXPECT_EQ(sheet.rows_up_to_d(), sheet.history().verdict.deploys_from_sample);
    deploying += sheet.metrics() != nullptr;
  }
  EXPECT_GT(deploying, 0);
}

// Shifts of a third of a panel: no state near flat is found, which is no exception.
// Sheets shifted so far that most have to be followed closely: an optimisation looks at a hundred
// thousand of them.
TEST(Sheet, LeavesNothingInItsSolver) {
  const DrawableSheet sheet(4, 4);
  const Model model(sheet.base);
  SheetSolver solver(model);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> shift_mm(-6, 6);
  const auto in_use_after = [&](int sheets) {
    for (int k = 0; k < sheets; ++k) {
      Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, sheet.base.sheet.vertex_count());
      for (const int vertex : sheet.shifted_vertices) {
        shifts_mm.col(vertex) << shift_mm(random), shift_mm(random);
      }
      EXPECT_GE(Sheet(solver, shifts_mm).record().verdict.deploys_from_sample, 0);
    }
    return static_cast<double>(mallinfo2().uordblks);
  };
  const double before = in_use_after(50);
  EXPECT_LT(in_use_after(200) - before, 1e5) << "bytes; the states of one path take 1e4";
}

TEST(Sheet, ThatIsLostHasNoWay) {
  const TestSheet sheet(4, 4);
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, sheet.base.sheet.vertex_count());
  std::srand(3);  // Eigen's Random
  for (const int v : interior_vertices(sheet.base.sheet)) {
    shifts_mm.col(v) = 27 * Eigen::Vector2d::Random();
  }
  const OwnSheet own(sheet.base, shifts_mm);
  for (int times = 0; times < 2; ++times) EXPECT_EQ(own.sheet.way(), nullptr);
  EXPECT_EQ(own.solver.paths().followed().as_functions, 1);
  EXPECT_EQ(own.sheet.metrics(), nullptr);
}

}  // namespace
}  // namespace misalign::solver
