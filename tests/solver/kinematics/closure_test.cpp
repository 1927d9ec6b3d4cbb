// Residual and Jacobian of loop closure.
#include <random>

#include "solver/kinematics/loop_closure.hpp"
#include "solver/linear/newton.hpp"
#include "tests/solver/dual.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

FoldState<double> random_state(const Mechanism& mechanism, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  std::normal_distribution<double> normal;
  FoldState<double> state;
  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    const double half = angle(random) / 2;
    state.creases.push_back({std::cos(half), std::sin(half)});
  }
  for (std::size_t i = 0; i < mechanism.balls.size(); ++i) {
    // Uniform on all rotations, so most are past 90 degrees.
    state.balls.push_back(
        Quaternion<double>{normal(random), normal(random), normal(random), normal(random)}
            .normalized());
  }
  return state;
}

FoldState<Dual> with_slope_in(const FoldState<double>& state, const Mechanism& mechanism,
                              int column) {
  FoldState<Dual> dual = as_dual(state);
  std::vector<Dual> delta(mechanism.unknowns);
  delta[column] = Dual(0, 1);
  advance(mechanism, delta.data(), dual);
  return dual;
}

TEST(LoopClosure, JacobianEqualsDualNumbersAtRandomStates) {
  const std::uint64_t seed = 20160235;
  std::mt19937_64 random(seed);
  for (const auto& [rows, columns] : {std::pair(4, 4), {6, 6}, {8, 6}}) {
    const TestSheet sheet(rows, columns);
    FlatVertices vertices = sheet.base.sheet.vertices_mm;
    std::uniform_real_distribution<double> shift(-0.4, 0.4);
    for (double& x : vertices.reshaped()) x += shift(random);
    SheetGeometry<double> geometry;
    place(sheet.mechanism, vertices, geometry);
    SheetGeometry<Dual> dual_geometry{{geometry.x.begin(), geometry.x.end()},
                                      {geometry.y.begin(), geometry.y.end()},
                                      {geometry.axis_x.begin(), geometry.axis_x.end()},
                                      {geometry.axis_y.begin(), geometry.axis_y.end()}};
    double worst = 0;
    for (int trial = 0; trial < 20; ++trial) {
      const auto state = random_state(sheet.mechanism, random);
      ClosureSystem system(sheet.mechanism);
      system.evaluate(geometry, state);
      const double scale = system.jacobian().cwiseAbs().maxCoeff();
      std::vector<Dual> residual(sheet.mechanism.equations);
      for (int column = 0; column < sheet.mechanism.unknowns; ++column) {
        const auto dual = with_slope_in(state, sheet.mechanism, column);
        evaluate<Dual>(sheet.mechanism, dual_geometry, dual, residual.data(), nullptr);
        for (int row = 0; row < sheet.mechanism.equations; ++row) {
          worst =
              std::max(worst, std::abs(residual[row].b - system.jacobian()(row, column)) / scale);
        }
      }
    }
    RecordProperty("worst_relative_error_" + std::to_string(rows), scientific(worst));
    EXPECT_LE(worst, 1e-12) << "seed " << seed << ", " << rows << " x " << columns;
  }
}

// The same with joints that displace what they turn.
TEST(LoopClosure, JacobianEqualsDualNumbersWithPlay) {
  const std::uint64_t seed = 20160235;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> off(-0.1, 0.1);
  const TestSheet sheet(6, 6);
  const Mechanism& mechanism = sheet.mechanism;
  const auto offsets_of = [&](std::size_t joints) {
    std::vector<Vec3<double>> offsets(joints);
    for (auto& offset : offsets) offset = {off(random), off(random), off(random)};
    return offsets;
  };
  const std::size_t creases = mechanism.creases.size();
  LooseSheet<double> loose;
  loosen(mechanism, sheet.geometry,
         {offsets_of(creases), offsets_of(creases), offsets_of(mechanism.balls.size())}, 1, loose);
  count_pilot_down(mechanism, half_angle_of_deg(100), loose);
  const auto dual = [](const auto& v) { return Vec3<Dual>{v.x, v.y, v.z}; };
  LooseSheet<Dual> dual_loose{{{loose.x.begin(), loose.x.end()},
                               {loose.y.begin(), loose.y.end()},
                               {loose.axis_x.begin(), loose.axis_x.end()},
                               {loose.axis_y.begin(), loose.axis_y.end()}},
                              {},
                              {}};
  const auto dual_pose = [&](const Pose<double>& pose) {
    const Mat3<double>& r = pose.rotation;
    return Pose<Dual>{{dual(r.cx), dual(r.cy), dual(r.cz)}, dual(pose.translation)};
  };
  for (const auto& pose : loose.creases) dual_loose.creases.push_back(dual_pose(pose));
  for (const auto& pose : loose.balls) dual_loose.balls.push_back(dual_pose(pose));
  double worst = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const auto state = random_state(mechanism, random);
    ClosureSystem system(mechanism);
    system.evaluate(loose, state);
    const double scale = system.jacobian().cwiseAbs().maxCoeff();
    std::vector<Dual> residual(mechanism.equations);
    for (int column = 0; column < mechanism.unknowns; ++column) {
      const auto moved = with_slope_in(state, mechanism, column);
      evaluate<Dual>(mechanism, dual_loose, moved, residual.data(), nullptr);
      for (int row = 0; row < mechanism.equations; ++row) {
        worst = std::max(worst, std::abs(residual[row].b - system.jacobian()(row, column)) / scale);
      }
    }
  }
  EXPECT_LE(worst, 1e-12) << "seed " << seed;
}

// A half turn has no skew part: the residual vanishes, and only the nine entries see it.
TEST(LoopClosure, HalfTurnDoesNotPass) {
  const Mat3<double> half_turn = Quaternion<double>{0, 0.6, 0.8, 0}.matrix();
  const Pose<double> loop{half_turn, {0, 0, 0}};
  EXPECT_NEAR(half_turn.cy.z - half_turn.cz.y, 0, 1e-15);
  EXPECT_NEAR(half_turn.cz.x - half_turn.cx.z, 0, 1e-15);
  EXPECT_NEAR(half_turn.cx.y - half_turn.cy.x, 0, 1e-15);
  EXPECT_GE(open_by(loop, 3), 1.0);
  EXPECT_LE(open_by(Pose<double>::identity(), 6), 0.0);
}

// The same on the sheet: a whole vertex whose facets were all turned over, two folds of 180 degrees
// along one line, closes; one alone is a half turn away from closing and must be seen as open.
TEST(LoopClosure, HalfTurnOfOneCreaseIsOpen) {
  const TestSheet sheet(4, 4);
  auto state = sheet.folded(0);
  std::vector<double> residual(sheet.mechanism.equations);
  ASSERT_LE(evaluate<double>(sheet.mechanism, sheet.geometry, state, residual.data(), nullptr),
            1e-15);
  for (const Loop& loop : sheet.mechanism.loops) {
    if (loop.rows != 3) continue;
    auto twisted = state;
    twisted.creases[loop.passages[0].joint] = {0, 1};
    evaluate<double>(sheet.mechanism, sheet.geometry, twisted, residual.data(), nullptr);
    for (int row = 0; row < 3; ++row) EXPECT_NEAR(residual[loop.first_row + row], 0, 1e-15);
    Pose<double> pose = Pose<double>::identity();
    for (const Passage& passage : loop.passages) {
      pose = pose.then_rotate(passage_rotation(sheet.mechanism, sheet.geometry, twisted, passage),
                              flat_point(sheet.geometry, passage.vertex));
    }
    EXPECT_GE(open_by(pose, 3), 1.0);
  }
}

// The translation is measured, not only the rotation: a hole pulled open without turning is open.
TEST(LoopClosure, PureTranslationIsOpen) {
  const Pose<double> loop{Mat3<double>::identity(), {0, 3e-12, 0}};
  EXPECT_DOUBLE_EQ(open_by(loop, 6), 3e-12);
  EXPECT_EQ(open_by(loop, 3), 0.0);
}

// Each loop passes each of its joints once, so no Jacobian place is written twice.
TEST(LoopClosure, JacobianPlacesAreDistinct) {
  const TestSheet sheet(8, 8);
  std::vector<std::pair<int, int>> places;
  for (const JacobianEntry& entry : jacobian_entries(sheet.mechanism)) {
    places.emplace_back(entry.row, entry.column);
  }
  std::sort(places.begin(), places.end());
  EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end());
}

}  // namespace
}  // namespace misalign::solver
