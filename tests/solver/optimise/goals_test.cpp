// What sheets are optimised for, against their own studies; and what is foreseen next to a sheet,
// against its neighbours.
#include "tests/solver/optimise/goals.hpp"

#include "solver/bending/preload.hpp"
#include "solver/bending/rest_stiffness.hpp"
#include "solver/certificate/certifier.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/actuation.hpp"
#include "solver/optimise/ascent.hpp"
#include "solver/optimise/chosen_friction.hpp"
#include "solver/optimise/deployed_angle.hpp"
#include "solver/optimise/goal_functions.hpp"
#include "solver/optimise/objective.hpp"
#include "solver/optimise/spare_diagonals.hpp"
#include "solver/optimise/thickness_changes.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::VectorXd;

struct GoalCase {
  const char *name, *goal;
  double rest_deg, preload_n;
  bool with_rate;  // whether the springs' rate may be chosen
  /// What is left out, of the change: how panels' give changes with the vertices; which pair of
  /// panels comes closest, or where; how the pose follows distances of some mm.
  double left_out;
  double between_angles = 1e-3, of_springs = 0.01;
  bool has_places = false;  // in place of a surface
};

class ForeseenGoals : public Goals, public testing::WithParamInterface<GoalCase> {};

// Changes of shifts and springs together; what is left goes with their square.
TEST_P(ForeseenGoals, ChangeAsTheySay) {
  const GoalCase& what = GetParam();
  options_.goal = goal_named(what.goal);
  if (options_.goal->needs_target) {
    WantedShape bent;
    if (!what.has_places) bent.surface = saddle(960);
    for (const int vertex : {0, 4, 12, 20, 24}) {
      if (!what.has_places) break;
      const Eigen::Vector2d at_mm = base_.base.sheet.vertices_mm.col(vertex);
      bent.places.push_back({vertex, {0.9 * at_mm.x(), 0.9 * at_mm.y(), vertex == 12 ? 15.0 : 0}});
    }
    options_.shape = std::make_shared<const ShapeMeasure>(*ShapeMeasure::of(solver_, bent, 60));
  }
  if (what.goal == std::string_view("spring_clearance_mm")) {
    springs().on = SpringsOn::one_a_hole;  // others cross
    options_.bodies = SpringBodies{.diameter_mm = 2, .fill = springs()};
  }
  springs().rest_deg = what.rest_deg;
  springs().preload.each_n = what.preload_n;
  if (what.with_rate) options_.stiffness_n_per_mm = {10, 100};
  if (what.preload_n > 0) options_.preload_n = {0, 4 * what.preload_n};
  std::uniform_real_distribution<double> part(-1, 1);
  int looked_at = 0;
  double worst = 0, worst_springs = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Sheet own(solver_, next_start());
    const auto value = value_of(*options_.goal, own, options_);
    if (!value) continue;
    if (*value <= 0 && !options_.goal->is_to_be_small && !options_.goal->has_any_sign) continue;
    const auto model = local_model(own, options_);
    ASSERT_TRUE(model) << what.name << ", trial " << trial;
    const LocalModel& local = *model;
    const VectorXd none = VectorXd::Zero(local.coordinates);
    // Energies between some angles stand for their derivatives.
    EXPECT_NEAR(local.goal(none) / *value, 1, what.between_angles)
        << what.name << ", trial " << trial;
    const Coordinates by(options_);
    const DesignPoint point = point_of(own.shifts_mm(), options_);
    const double goal = local.goal(none);
    const auto left = [&](const VectorXd& change_mm) {
      const DesignPoint there = by.after(point, change_mm);
      OptimiseOptions options = options_;
      set_springs(options, there);
      const Sheet other(solver_, there.shifts_mm);
      return *value_of(*options_.goal, other, options) - *value - (local.goal(change_mm) - goal);
    };
    constexpr double kSize_mm = 2e-4;
    const VectorXd change_mm = none.unaryExpr([&](double) { return kSize_mm * part(random_); });
    double row = 0;
    for (const GoalTerm& one : local.goals) row = std::max(row, one.row.norm() / one.divisor);
    worst = std::max(worst, std::abs(left(change_mm)) / (row * change_mm.norm()));
    for (Index k = 0; k < local.coordinates; ++k) {
      if (!by.range(k)) continue;
      const VectorXd of_springs = kSize_mm * VectorXd::Unit(local.coordinates, k);
      // Of what a change by as much of them all would be: next to a best one there is none.
      const double its = k + 1 == local.coordinates && options_.preload_n
                             ? point.preload_n
                             : point.stiffness_n_per_mm;
      const double share = kSize_mm * by.per_mm(*by.range(k)) / its;
      worst_springs = std::max(worst_springs, std::abs(left(of_springs)) / (share * *value));
    }
    ++looked_at;
  }
  RecordProperty("worst_springs", scientific(worst_springs));
  EXPECT_LE(worst_springs, what.of_springs) << what.name << ", seed " << seed_;
  RecordProperty("worst", scientific(worst));
  EXPECT_GE(looked_at, 4);
  EXPECT_LE(worst, what.left_out) << what.name << ", seed " << seed_;
}

INSTANTIATE_TEST_SUITE_P(
    Optimised, ForeseenGoals,
    testing::Values(
        GoalCase{"energy", "energy_n_mm", 0, 0.1, true, 2e-3},
        GoalCase{"critical", "critical_friction_n_mm_per_mm", 0, 0.1, true, 2e-3, 2e-3},
        GoalCase{"relaxed_elsewhere", "energy_n_mm", 20, 0, true, 2e-3},
        GoalCase{"bent", "bent_critical_friction_n_mm_per_mm", 0, 0.02, true, 5e-3, 0.02},
        GoalCase{"slowly", "static_friction_n_mm_per_mm", 0, 0.02, true, 5e-3, 0.15, 0.15},
        GoalCase{"deployed", "rest_stiffness_n_mm_per_rad", 0, 0.02, false, 5e-3},
        GoalCase{"stop", "rest_stiffness_n_mm_per_rad", 60, 0, true, 0.03},
        GoalCase{"thickness", "thickness_mm", 0, 0, false, 0.08, 0.02},
        GoalCase{"stress", "largest_stress_mpa", 0, 0.02, true, 0.3, 1e-3, 0.05},
        GoalCase{"buckling", "buckling_factor", 0, 0.02, true, 0.3, 1e-3, 0.05},
        GoalCase{"clearance", "spring_clearance_mm", 0, 0, false, 0.08, 0.02},
        GoalCase{"shape_rms", "shape_rms_mm", 0, 0, false, 2e-5, 1e-6},
        GoalCase{"shape_max", "shape_max_mm", 0, 0, false, 0.01, 1e-6},
        GoalCase{"places_rms", "shape_rms_mm", 0, 0, false, 2e-5, 1e-6, 0, true},
        GoalCase{"places_max", "shape_max_mm", 0, 0, false, 5e-3, 1e-6, 0, true}),
    [](const auto& one) { return std::string(one.param.name); });

// The least distance of any two panels, by solving the sheet again.
TEST_F(Goals, DistancesChangeAsTheySay) {
  std::uniform_real_distribution<double> part(-1, 1), angle_deg(20, 140);
  double worst = 0;
  int apart = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Sheet own(solver_, next_start());
    const double pilot_deg = angle_deg(random_);
    PathGradients gradients(own);
    const PathGradients::Shape folded = *gradients.vertices(pilot_deg);
    Matrix2Xd direction(2, own.shifts_mm().cols());
    for (double& entry : direction.reshaped()) entry = part(random_);
    constexpr double kStep_mm = 1e-3;
    const auto pose = [&](int steps) {
      const Sheet other(solver_, own.shifts_mm() + steps * kStep_mm * direction);
      return *PathGradients(other).vertices(pilot_deg);
    };
    const PathGradients::Shape low = pose(-1), high = pose(1);
    const auto panel = [&](const PathGradients::Shape& where, int k) {
      PolygonCorners corners(3, 4);
      for (int c = 0; c < 4; ++c) {
        corners.col(c) = where.at_mm.col(
            own.panels().corners[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)]);
      }
      return corners;
    };
    const auto flat = trimmed_panels(own.panels(), own.way()->from_a1_mm(), 0);
    for (const PanelPair& pair : pairs_of(own.panels())) {
      if (pair.kind != ContactKind::apart) continue;
      const auto placed = [&](int which) {
        return placed_panel(own, folded, which, flat[static_cast<std::size_t>(which)]);
      };
      const LengthGradient found = distance_gradient(placed(pair.a), placed(pair.b), folded);
      const auto distance = [&](const PathGradients::Shape& where) {
        return separation_of(panel(where, pair.a), panel(where, pair.b)).distance;
      };
      EXPECT_NEAR(found.mm, distance(folded), 1e-9);
      const double by = (distance(high) - distance(low)) / (2 * kStep_mm),
                   bend = distance(high) + distance(low) - 2 * distance(folded);
      // Where other points of them come closest a distance has a corner.
      if (std::abs(bend) > 1e-6) continue;
      ++apart;
      worst = std::max(worst, std::abs(by - found.by_mm.dot(direction.reshaped())) /
                                  (found.by_mm.norm() * direction.norm()));
    }
  }
  RecordProperty("worst", scientific(worst));
  EXPECT_GT(apart, 100);
  EXPECT_LE(worst, 1e-5) << "seed " << seed_ << ": central differences of 1e-3 mm";
}

// Of bent panels held on either side of a stop, and of flat.
TEST_F(Goals, RestStiffnessIsTheCurvatureOfTheEnergy) {
  for (int trial = 0; trial < 3; ++trial) {
    const Sheet sheet(solver_, next_start());
    const double n_per_mm = springs().stiffness_n_per_mm;
    springs().preload.each_n = 0;
    springs().rest_deg = 60;
    const RestStiffness stop = *rest_stiffness(sheet, options_.deploying, {});
    const BentWay way(sheet, {}, 1, 50, 60.2, 16);
    VectorXd relaxed_mm, rates;
    sheet.way()->find_lengths(sheet.way()->x_of(60), relaxed_mm, rates);
    const auto bent =
        way.bend(Filling::of_springs(VectorXd::Constant(relaxed_mm.size(), n_per_mm), relaxed_mm),
                 BendMethod::linear);
    int near = 0;
    for (const BentAngle& angle : bent) {
      const double off_rad = (angle.pilot_deg - 60) * kRadPerDeg;
      if (std::abs(off_rad) > 0.04) continue;
      ++near;
      EXPECT_NEAR(2 * angle.bent.n_mm / (off_rad * off_rad) / stop.n_mm_per_rad, 1,
                  2 * std::abs(off_rad))
          << "trial " << trial << " at " << angle.pilot_deg;
    }
    EXPECT_GE(near, 3);
    springs().rest_deg = 0;
    springs().preload.each_n = 0.02;
    const RestStiffness flat = *rest_stiffness(sheet, options_.deploying, {});
    const PreloadAtFlat at_flat = *preload_at_flat(sheet, {}, 1, sides_of_diagonals(*sheet.way()));
    // The preload is the difference of two lengths, 4e-4 of 140 mm.
    EXPECT_NEAR(flat.n_mm_per_rad / at_flat.stiffness_n_mm(0.02), 1, 1e-9);
    springs().rest_deg = 60;
    EXPECT_FALSE(rest_stiffness(sheet, options_.deploying, {})) << "at a stop, with a preload";
  }
}

TEST_F(Goals, SpareDiagonalsAreThoseOfActuators) {
  int fewer = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Sheet sheet(solver_, next_start());
    const EnergyModel rigid(sheet, options_.deploying.sheet);
    const auto found = spare_diagonals(sheet, rigid, 36);
    const Actuation springs = actuate(sheet, {}, 36);
    ASSERT_EQ(found.has_value(), springs.few.has_value()) << "trial " << trial;
    if (!found) continue;
    EXPECT_EQ(found->few.diagonals, springs.few->diagonals);
    EXPECT_NEAR(found->few.share, springs.few->share, 1e-6);
    const auto all = static_cast<double>(sheet.mechanism().diagonal_count());
    EXPECT_EQ(std::floor(found->amount), all - static_cast<double>(springs.few->diagonals.size()));
    if (found->few.fewer.empty()) continue;
    ++fewer;
    EXPECT_EQ(found->few.fewer.size() + 1, found->few.diagonals.size());
    EXPECT_LT(found->few.share_of_fewer, kShareOfFew);
    EXPECT_NEAR(found->amount - std::floor(found->amount),
                std::max(0.0, found->few.share_of_fewer) / kShareOfFew, 1e-12);
  }
  EXPECT_GT(fewer, 0);
}

// Farther than any draw: up to where it is proven.
TEST_F(Goals, SheetsComeToDeployFromFarther) {
  options_.goal = goal_named("deploys_from_deg");
  options_.most_steps = 60;
  int farther = 0, turning = 0;
  for (int trial = 0; trial < 2; ++trial) {
    const Sheet start(solver_, next_start());
    const Optimised found = *optimise(start, options_);
    for (std::size_t k = 1; k < found.taken.size(); ++k) {
      EXPECT_GT(found.taken[k].value, found.taken[k - 1].value);
      // A diagonal turns back there, if the sheet folds on: within the last two degrees before 180,
      // where paths bend sharply, places are known to a tenth of one.
      const Sheet sheet(solver_, found.taken[k].shifts_mm);
      const double at_deg = found.taken[k].value, near_deg = at_deg < 178 ? 0.01 : 0.1;
      const auto over_deg = sheet.way()->over_folded_deg();
      if (at_deg + 0.1 >= sheet.way()->end_deg()) continue;
      if (over_deg && std::abs(*over_deg - at_deg) < 0.1) continue;
      VectorXd lengths_mm, before_mm, behind_mm;
      sheet.way()->find_lengths(sheet.way()->x_of(at_deg - near_deg), lengths_mm, before_mm);
      sheet.way()->find_lengths(sheet.way()->x_of(at_deg + near_deg), lengths_mm, behind_mm);
      EXPECT_LT(before_mm.cwiseProduct(behind_mm).minCoeff(), 0) << at_deg;
      ++turning;
    }
    const Sheet end(solver_, found.best().shifts_mm);
    // The last sample before it; at 180 degrees itself rounding decides.
    EXPECT_EQ(std::min(179.0, end.deploys_from_deg()),
              std::min(179.0, std::floor(found.best().value)));
    EXPECT_LE(found.best().shifts_mm.cwiseAbs().maxCoeff(), 0.4);
    farther += found.best().value > found.start().value + 3;
  }
  EXPECT_EQ(farther, 2);
  EXPECT_GT(turning, 1);
}

// Against a path that is followed to just before and just behind.
TEST_F(Goals, ACreaseIsFoldedFlatWhereTheySay) {
  constexpr double kBeside_deg = 1e-3;
  int folded_flat = 0;
  std::uniform_real_distribution<double> shift_mm(-0.4, 0.4);
  for (int trial = 0; trial < 300; ++trial) {
    Matrix2Xd shifts_mm = Matrix2Xd::Zero(2, base_.base.sheet.vertex_count());
    for (const int vertex : base_.shifted_vertices) {
      for (double& shift : shifts_mm.col(vertex)) shift = shift_mm(random_);
    }
    const Sheet sheet(solver_, shifts_mm);
    if (!sheet.way() || !sheet.way()->over_folded_deg()) continue;
    const double until_deg = goes_until_deg(sheet);
    if (std::abs(until_deg - *sheet.way()->over_folded_deg()) > 0.1) continue;  // a diagonal turns
    PathPlanOptions close;
    close.look_at_deg = {until_deg - kBeside_deg, until_deg + kBeside_deg, until_deg + 0.1};
    const Model model(base_.base, close);
    SheetSolver solver(model);
    const Sheet followed(solver, shifts_mm);
    const FoldingHistory& history = followed.history();
    const auto fold_deg = [&](double angle_deg) {
      Index row = 0;
      while (history.stations[static_cast<std::size_t>(row)].pilot_deg < angle_deg - 1e-9) ++row;
      return history.fold_angle_deg.row(row).cwiseAbs().maxCoeff();
    };
    // One that only touches 180 degrees, in a sharp bend, stays within rounding of the path.
    if (until_deg + 0.1 >= sheet.way()->end_deg() || fold_deg(until_deg + 0.1) < 180) continue;
    for (const double off_deg : {-kBeside_deg, kBeside_deg}) {
      EXPECT_EQ(fold_deg(until_deg + off_deg) > 180, off_deg > 0)
          << "seed " << seed_ << ", trial " << trial << ", at " << until_deg;
      ++folded_flat;
    }
  }
  EXPECT_GE(folded_flat, 10);
}

TEST_F(Goals, ThicknessAndYieldGrowAsTheirStudiesSay) {
  options_.goal = goal_named("thickness_mm");
  options_.most_evaluations = 20;
  options_.most_steps = 3;
  const Sheet start(solver_, next_start());
  const Optimised found = *optimise(start, options_);
  EXPECT_GT(found.best().value, found.start().value);
  const Sheet end(solver_, found.best().shifts_mm);
  EXPECT_EQ(found.best().value, contact(end, {{}, 150})->thickness->thickness_mm);

  const Model judged(base_.base, base_.shifted_vertices, {}, 150);
  SheetSolver solver(judged);
  options_.goal = goal_named("yield");
  // Of sheets a little off, by their own verdicts.
  options_.yield = [&](const Sheet& sheet) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> off_mm(-0.1, 0.1);
    int deploys = 0;
    constexpr int kCopies = 40;
    for (int k = 0; k < kCopies; ++k) {
      const Matrix2Xd copy_mm =
          sheet.shifts_mm().unaryExpr([&](double mm) { return mm + off_mm(random); });
      deploys += Sheet(solver, copy_mm).deploys_from_deg() >= 150;
    }
    return std::optional(static_cast<double>(deploys) / kCopies);
  };
  for (int trial = 0; trial < 2; ++trial) {
    const Sheet own(solver, next_start());
    if (*options_.yield(own) == 0 || *options_.yield(own) == 1) continue;
    const Optimised made = *optimise(own, options_);
    EXPECT_GT(made.best().value, made.start().value);
    EXPECT_LE(made.best().value, 1);
  }
}

}  // namespace
}  // namespace misalign::solver
