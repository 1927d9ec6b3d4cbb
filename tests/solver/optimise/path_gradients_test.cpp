// Gradients along a way, against differences between whole ways of sheets that are cut a little
// otherwise.
#include "solver/optimise/path_gradients.hpp"

#include <random>

#include "solver/linear/newton.hpp"
#include "tests/solver/dual.hpp"
#include "tests/solver/families.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// Of five points: what is left goes with the fourth power of the step.
template <class Quantity>
auto difference(const Quantity& at, double step_mm) -> decltype(at(0)) {
  return ((at(-2) - at(2)) / 12 + (at(1) - at(-1)) * 2 / 3) / step_mm;
}

// Lengths (mm), then fold angles (deg).
Eigen::VectorXd folded(const Model& model, const FlatVertices& vertices_mm,
                       const FoldState<double>& near) {
  SheetGeometry<double> geometry;
  place(model.mechanism(), vertices_mm, geometry);
  FoldState<double> state = near;
  Newton newton(model.mechanism());
  EXPECT_EQ(newton.correct(geometry, state).end, Newton::StopReason::converged);
  const Mechanism& mechanism = model.mechanism();
  const Eigen::Index diagonals = mechanism.diagonal_count();
  Eigen::VectorXd numbers(diagonals + std::ssize(mechanism.creases));
  folded_lengths(mechanism, geometry, state, numbers.data());
  numbers.head(diagonals) *= mechanism.panel_width_mm;
  for (std::size_t c = 0; c < mechanism.creases.size(); ++c) {
    numbers(diagonals + static_cast<Eigen::Index>(c)) =
        mechanism.side * angle_deg(state.creases[c]);
  }
  return numbers;
}

// How the same numbers change along a direction, by Newton's method in dual numbers: the closure's
// own arithmetic forwards, and none of what the gradients transpose.
Eigen::VectorXd changing(const Model& model, const FlatVertices& vertices_mm,
                         const Eigen::Matrix2Xd& direction, const FoldState<double>& near) {
  const Mechanism& mechanism = model.mechanism();
  SheetGeometry<double> geometry;
  place(mechanism, vertices_mm, geometry);
  FoldState<double> solved = near;
  Newton newton(mechanism);
  EXPECT_EQ(newton.correct(geometry, solved).end, Newton::StopReason::converged);
  ClosureSystem system(mechanism);
  system.evaluate(geometry, solved);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(system.jacobian().leftCols(mechanism.equations));
  const SheetGeometry<Dual> moving = placed(mechanism, vertices_mm, direction);
  FoldState<Dual> state = as_dual(solved);
  std::vector<Dual> residual(static_cast<std::size_t>(mechanism.equations));
  for (int step = 0; step < 3; ++step) {
    evaluate<Dual>(mechanism, moving, state, residual.data(), nullptr);
    Eigen::MatrixX2d open(mechanism.equations, 2);
    for (int row = 0; row < mechanism.equations; ++row) {
      open.row(row) << residual[static_cast<std::size_t>(row)].a,
          residual[static_cast<std::size_t>(row)].b;
    }
    const Eigen::MatrixX2d closing = -lu.solve(open);
    std::vector<Dual> delta(static_cast<std::size_t>(mechanism.unknowns));  // the pilot is held
    for (int row = 0; row < mechanism.equations; ++row) {
      delta[static_cast<std::size_t>(row)] = {closing(row, 0), closing(row, 1)};
    }
    advance(mechanism, delta.data(), state);
  }
  std::vector<Dual> lengths(mechanism.diagonals.size());
  folded_lengths(mechanism, moving, state, lengths.data());
  Eigen::VectorXd by(std::ssize(lengths) + std::ssize(state.creases));
  Eigen::Index k = 0;
  for (const Dual& length : lengths) by(k++) = length.b * mechanism.panel_width_mm;
  for (const HalfAngle<Dual>& rho : state.creases) {
    by(k++) = mechanism.side * 2 * (rho.c.a * rho.s.b - rho.s.a * rho.c.b) / kRadPerDeg;
  }
  return by;
}

// How a quantity of the diagonals changes with the pilot's angle, per radian: states are solved on
// both sides.
template <class Quantity>
Eigen::VectorXd by_pilot(const Model& model, const FoldState<double>& near,
                         const Quantity& quantity) {
  constexpr double kStep_rad = 4e-4;
  const auto at = [&](int steps) -> Eigen::VectorXd {
    const Mechanism& mechanism = model.mechanism();
    FoldState<double> state = near;
    const Eigen::VectorXd turn =
        steps * kStep_rad * Eigen::VectorXd::Unit(mechanism.unknowns, mechanism.equations);
    advance(mechanism, turn.data(), state);
    return quantity(state).head(mechanism.diagonal_count());
  };
  return difference(at, kStep_rad);
}

TEST(PathGradients, EqualDifferencesBetweenWays) {
  const std::uint64_t seed = 20261127;
  std::mt19937_64 random(seed);
  constexpr double kStep_mm = 0.02;
  double worst = 0, most = 0;
  for (const auto& [size, amplitude_mm] : {std::pair{4, 0.4}, {6, 0.4}, {6, 4.0}}) {
    std::uniform_real_distribution<double> shift(-amplitude_mm, amplitude_mm);
    const DrawableSheet sheet{size, size};
    const Model model(sheet.base);
    SheetSolver solver(model);
    Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, sheet.base.sheet.vertex_count());
    for (const int vertex : sheet.shifted_vertices) {
      shifts_mm.col(vertex) << shift(random), shift(random);
    }
    const Sheet own(solver, shifts_mm);
    ASSERT_TRUE(own.way());
    PathGradients gradients(own);
    for (const double pilot_deg : {5.0, 36.0, 100.0}) {
      const PathGradients::AtAngle found = *gradients.at(pilot_deg);
      FoldState<double> state = own.way()->stations().front().state;
      own.way()->find_state(own.way()->x_of(pilot_deg), state);
      for (Eigen::Index k = 0; k < 2 * shifts_mm.cols(); ++k) {
        const Eigen::VectorXd by = difference(
            [&](int steps) {
              FlatVertices vertices_mm = own.vertices_mm();
              vertices_mm.data()[k] += steps * kStep_mm;
              return folded(model, vertices_mm, state);
            },
            kStep_mm);
        Eigen::VectorXd foreseen(by.size());
        foreseen << found.length_by_mm.col(k), found.fold_by_mm.col(k);
        worst = std::max(worst, (by - foreseen).cwiseAbs().maxCoeff());
        most = std::max(most, found.length_by_mm.col(k).cwiseAbs().maxCoeff());
      }
    }
  }
  RecordProperty("worst", scientific(worst));
  EXPECT_GT(most, 0.1);
  EXPECT_LE(worst, 1e-7) << "seed " << seed;
}

TEST(PathGradients, FoldLimitsMoveAsTheySay) {
  const std::uint64_t seed = 20261128;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  const DrawableSheet sheet{4, 4};
  const Model model(sheet.base);
  SheetSolver solver(model);
  int limits = 0;
  double worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, sheet.base.sheet.vertex_count());
    for (const int vertex : sheet.shifted_vertices) {
      shifts_mm.col(vertex) << shift(random), shift(random);
    }
    const Sheet own(solver, shifts_mm);
    if (!own.way() || !own.way()->ends_at_limit()) continue;
    ++limits;
    const PathGradients::AtLimit found = *PathGradients(own).fold_limit();
    Eigen::Matrix2Xd direction = Eigen::Matrix2Xd::Zero(2, shifts_mm.cols());
    for (const int vertex : sheet.shifted_vertices) {
      direction.col(vertex) << shift(random), shift(random);
    }
    constexpr double kStep = 0.004;  // next to flat folded limits move by degrees per mm, unevenly
    const double by = difference(
        [&](int steps) {
          const Sheet other(solver, shifts_mm + steps * kStep * direction);
          return other.way()->end_deg();
        },
        kStep);
    const double foreseen =
        found.by_mm * Eigen::Map<const Eigen::VectorXd>(direction.data(), direction.size());
    worst = std::max(worst, std::abs(by - foreseen) / (found.by_mm.norm() * direction.norm()));
  }
  RecordProperty("worst", scientific(worst));
  EXPECT_GE(limits, 10);
  EXPECT_LE(worst, 5e-5) << "seed " << seed << ": limits are known to 1e-7 degrees";
}

class PathGradientsOfFamilies : public testing::TestWithParam<std::string> {};

// 200 sheets of each family at an angle each, along a direction in which every vertex moves; by
// dual numbers and by differences.
TEST_P(PathGradientsOfFamilies, EqualDualNumbersAndDifferences) {
  constexpr int kSheets = 200, kLimits = 8;
  const CarriedFamily family(GetParam());
  const Model model(family.base);
  SheetSolver solver(model);
  const ShiftBlock draws = family.draws(kSheets, 39);
  std::mt19937_64 random(39);
  std::uniform_real_distribution<double> part(-1, 1), angle_deg(5, 100);
  const double step_mm = 2.5e-5 * family.base.sheet.panel_width_mm;
  double worst = 0, worst_dual = 0, worst_slope = 0, worst_limit = 0;
  int sheets = 0, limits = 0, jumping = 0;
  for (int trial = 0; trial < kSheets; ++trial) {
    const Eigen::Matrix2Xd shifts_mm =
        family.vertices(draws, trial) - family.base.sheet.vertices_mm;
    const double pilot_deg = angle_deg(random);
    Eigen::Matrix2Xd direction(2, shifts_mm.cols());
    for (double& entry : direction.reshaped()) entry = part(random);
    const Sheet own(solver, shifts_mm);
    if (!own.way() || own.way()->end_deg() < pilot_deg + 20) continue;
    ++sheets;
    PathGradients gradients(own);
    const auto at_angle = gradients.at(pilot_deg);
    ASSERT_TRUE(at_angle) << "sheet " << trial << " at " << pilot_deg << " of "
                          << own.way()->end_deg();
    const PathGradients::AtAngle& found = *at_angle;
    const Eigen::Map<const Eigen::VectorXd> along(direction.data(), direction.size());
    FoldState<double> state = own.way()->stations().front().state;
    own.way()->find_state(own.way()->x_of(pilot_deg), state);
    const Eigen::VectorXd by = difference(
        [&](int steps) {
          return folded(model, own.vertices_mm() + steps * step_mm * direction, state);
        },
        step_mm);
    Eigen::VectorXd foreseen(by.size());
    foreseen << found.length_by_mm * along, found.fold_by_mm * along;
    worst = std::max(worst, (by - foreseen).norm() / foreseen.norm());
    const Eigen::VectorXd dual = changing(model, own.vertices_mm(), direction, state);
    worst_dual = std::max(worst_dual, (dual - foreseen).norm() / foreseen.norm());
    const PathGradients::Slopes slopes = *gradients.slopes(pilot_deg);
    const Eigen::VectorXd slope = by_pilot(model, state, [&](const FoldState<double>& there) {
      return folded(model, own.vertices_mm(), there);
    });
    const Eigen::VectorXd steeper = by_pilot(model, state, [&](const FoldState<double>& there) {
      return changing(model, own.vertices_mm(), direction, there);
    });
    worst_slope = std::max({worst_slope, (slope - slopes.slope_mm_per_rad).norm() / slope.norm(),
                            (steeper - slopes.slope_by_mm * along).norm() / steeper.norm()});
    if (!own.way()->ends_at_limit() || limits == kLimits) continue;
    ++limits;
    const auto at_limit = gradients.fold_limit();
    ASSERT_TRUE(at_limit) << "sheet " << trial;
    const PathGradients::AtLimit& limit = *at_limit;
    // Where another limit comes up before this one its place jumps, and has no derivative.
    bool jumps = false;
    const double moves = difference(
        [&](int steps) {
          const Sheet other(solver, shifts_mm + steps * step_mm * direction);
          jumps = jumps || std::abs(other.way()->end_deg() - limit.fold_limit_deg) > 0.5;
          return other.way()->end_deg();
        },
        step_mm);
    jumping += jumps;
    if (jumps) continue;
    worst_limit = std::max(worst_limit, std::abs(moves - limit.by_mm.dot(along)) /
                                            (limit.by_mm.norm() * along.norm()));
  }
  RecordProperty("worst", scientific(worst));
  RecordProperty("worst_dual", scientific(worst_dual));
  RecordProperty("worst_slope", scientific(worst_slope));
  RecordProperty("worst_limit", scientific(worst_limit));
  EXPECT_GE(sheets, kSheets / 2);
  EXPECT_LE(worst, 1e-7);
  EXPECT_LE(worst_dual, 1e-9) << "rounding, and how well states are known";
  EXPECT_LE(worst_slope, 1e-7);
  EXPECT_LE(jumping, 1) << "of " << limits;
  EXPECT_LE(worst_limit, 5e-5) << limits << " limits, known to 1e-7 degrees";
}

INSTANTIATE_TEST_SUITE_P(Carried, PathGradientsOfFamilies, testing::ValuesIn(carried_families()),
                         family_word);

}  // namespace
}  // namespace misalign::solver
