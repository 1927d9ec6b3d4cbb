// Better sheets, against what their own studies and all of their neighbours say.
#include "solver/optimise/optimise.hpp"

#include "solver/motion/actuation.hpp"
#include "solver/motion/equilibria.hpp"
#include "solver/optimise/local_model.hpp"
#include "solver/optimise/objective.hpp"
#include "tests/solver/few_holes.hpp"
#include "tests/solver/optimise/optimising.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::solver {
namespace {

using Eigen::Matrix2Xd;
using Eigen::VectorXd;

// What is said of sheets near one, against their own lengths and studies: the error goes with the
// square of the change.
TEST_F(Optimising, TheLocalModelForeseesItsNeighbours) {
  for (int trial = 0; trial < 5; ++trial) {
    const Matrix2Xd shifts_mm = next_start(false);
    const Sheet own(solver_, shifts_mm);
    options_.stroke_limit = 0.2;
    const LocalModel model = *local_model(own, options_);
    EXPECT_NEAR(model.goal(VectorXd::Zero(model.goals[0].row.size())) / friction(shifts_mm), 1,
                1e-3);
    for (const double size_mm : {1e-3, 1e-4}) {
      VectorXd change_mm(model.goals[0].row.size());
      Matrix2Xd changed_mm = shifts_mm;
      for (Eigen::Index k = 0; k < change_mm.size(); ++k) {
        change_mm(k) = size_mm * (static_cast<double>(random_() % 1000) / 500 - 1);
        changed_mm(k % 2, options_.shifted[static_cast<std::size_t>(k / 2)]) += change_mm(k);
      }
      const Sheet other(solver_, changed_mm);
      const LocalModel there = *local_model(other, options_);
      ASSERT_EQ(there.rows.size(), model.rows.size());
      double worst = 0;
      for (std::size_t k = 0; k < model.rows.size(); ++k) {
        const LocalModel::Row& row = model.rows[k];
        // A fold limit's place changes unevenly next to where it is flat folded.
        if (row.kind == LocalModel::Row::Kind::fold_limit ||
            row.pilot_deg != there.rows[k].pilot_deg)
          continue;
        worst = std::max(worst, std::abs(row.slack + row.row.dot(change_mm) - there.rows[k].slack));
      }
      EXPECT_LE(worst, 100 * size_mm * size_mm) << "seed " << seed_ << ", trial " << trial;
      EXPECT_NEAR(friction(changed_mm) - friction(shifts_mm),
                  model.goal(change_mm) - model.goal(0 * change_mm),
                  0.3 * size_mm * std::abs(friction(shifts_mm)) + 10 * size_mm * size_mm)
          << "trial " << trial;
    }
  }
}

TEST_F(Optimising, EndsFitAndNoFlipDoesBetter) {
  options_.ternary = true;
  for (int trial = 0; trial < 3; ++trial) {
    const Matrix2Xd start = next_start(true);
    const Optimised found = *optimise(Sheet(solver_, start), options_);
    EXPECT_EQ(found.start().value, friction(start));
    EXPECT_EQ(found.best().value, friction(found.best().shifts_mm));
    EXPECT_GT(found.best().value, found.start().value);
    for (std::size_t k = 1; k < found.taken.size(); ++k) {
      EXPECT_GT(found.taken[k].value, found.taken[k - 1].value);
      EXPECT_GE(Sheet(solver_, found.taken[k].shifts_mm).history().verdict.deploys_from_sample,
                150);
    }
    for (const int vertex : options_.shifted) {
      for (const int axis : {0, 1}) {
        for (const double to_mm : {-0.4, 0.0, 0.4}) {
          Matrix2Xd flipped = found.best().shifts_mm;
          EXPECT_TRUE(flipped(axis, vertex) == 0 || std::abs(flipped(axis, vertex)) == 0.4);
          flipped(axis, vertex) = to_mm;
          const Sheet other(solver_, flipped);
          if (other.deploys_from_deg() < 150) continue;
          EXPECT_LE(friction(flipped), found.best().value * (1 + 1e-4)) << "trial " << trial;
        }
      }
    }
  }
}

TEST_F(Optimising, KeepsWhatItsSpringsBear) {
  for (const bool ternary : {true, false}) {
    options_.ternary = ternary;
    const Matrix2Xd start = next_start(true);
    const Sheet sheet(solver_, start);
    const auto force_n = [](const Sheet& of) {
      const Actuation springs = actuate(of, {}, 36);
      return springs.force_n.row(springs.from_row).cwiseAbs().maxCoeff();
    };
    options_.largest_force_n = 1.2 * force_n(sheet);
    const Optimised found = *optimise(sheet, options_);
    EXPECT_LE(force_n(Sheet(solver_, found.best().shifts_mm)),
              *options_.largest_force_n * (1 + 1e-9));
    options_.largest_force_n.reset();
    EXPECT_GT(optimise(sheet, options_)->best().value, found.best().value);
  }
}

// Free shifts do at least as well as the ternary ones that they begin with, keep the stroke limit,
// and say what a larger amplitude would give.
TEST_F(Optimising, FreeShiftsGoOnFromTernaryOnes) {
  options_.ternary = true;
  options_.stroke_limit = 0.03;
  Matrix2Xd start = next_start(true);
  while (Sheet(solver_, start).metrics()->stroke_max > 0.03) start = next_start(true);
  const Optimised flipped = *optimise(Sheet(solver_, start), options_);
  options_.ternary = false;
  const Optimised found = *optimise(Sheet(solver_, flipped.best().shifts_mm), options_);
  EXPECT_GE(found.best().value, flipped.best().value);
  EXPECT_LE(found.best().shifts_mm.cwiseAbs().maxCoeff(), 0.4 * (1 + 1e-12));
  const Sheet end(solver_, found.best().shifts_mm);
  EXPECT_LE(end.metrics()->stroke_max, 0.03);
  ASSERT_TRUE(found.limits);
  if (found.stop_reason != Optimised::StopReason::no_step_is_better) return;
  EXPECT_GT(found.limits->per_share_of_stroke + found.limits->per_mm_of_amplitude, 0);
}

TEST_F(Optimising, BentPanelsHaveTheirOwnGoals) {
  options_.ternary = true;
  options_.deploying.sheet.springs().preload.each_n = 0.02;
  for (const Goal* const goal : {goal_named("bent_critical_friction_n_mm_per_mm"),
                                 goal_named("static_friction_n_mm_per_mm")}) {
    options_.goal = goal;
    const Matrix2Xd start = next_start(true);
    const Optimised found = *optimise(Sheet(solver_, start), options_);
    const Sheet end(solver_, found.best().shifts_mm);
    const BentFriction friction = bend_panels(end, options_.deploying, options_.bending)->friction;
    EXPECT_EQ(found.best().value, goal == goal_named("static_friction_n_mm_per_mm")
                                      ? friction.static_n_mm_per_mm
                                      : *friction.critical_n_mm_per_mm);
    EXPECT_GT(found.best().value, found.start().value);
  }
}

// Slopes at close stations of a path that is followed, over the sine of the pilot's angle.
double followed_slope_mm_per_deg(const PerforatedSheet& base, const Matrix2Xd& shifts_mm,
                                 double to_deg) {
  PathPlanOptions close;
  close.look_deg = 0.25;
  const Model model(base, close);
  SheetSolver solver(model);
  const Sheet sheet(solver, shifts_mm);
  const FoldingHistory& history = sheet.history();
  Eigen::Index last = 0;
  while (history.stations[static_cast<std::size_t>(last)].pilot_deg < to_deg - 1e-9) ++last;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
    const double longer_mm =
        history.length_mm(last, d) - history.flat_mm[static_cast<std::size_t>(d)];
    for (Eigen::Index row = 0; row <= last; ++row) {
      const double pilot_deg = history.stations[static_cast<std::size_t>(row)].pilot_deg;
      least = std::min(least, (longer_mm < 0 ? -1 : 1) * history.slope_mm_per_deg(row, d) /
                                  std::sin(pilot_deg * kRadPerDeg));
    }
  }
  return least;
}

// At every angle, where that is asked; in the mean between angles a slope may be less in between.
TEST_F(Optimising, KeepsTheLeastSlope) {
  options_.least_slope_mm_per_deg = 2e-3;
  int kept = 0, missed_by_means = 0;
  for (int trial = 0; trial < 40 && kept < 3; ++trial) {
    const Matrix2Xd start = next_start(false);
    if (followed_slope_mm_per_deg(base_.base, start, 150) < 2e-3) continue;
    for (const bool everywhere : {false, true}) {
      options_.slope_at_every_angle = everywhere;
      const Optimised found = *optimise(Sheet(solver_, start), options_);
      const double least = followed_slope_mm_per_deg(base_.base, found.best().shifts_mm, 150);
      EXPECT_GT(found.best().value, 1.2 * found.start().value);
      if (everywhere) {
        EXPECT_GE(least, 2e-3 * (1 - 1e-3)) << "seed " << seed_ << ", trial " << trial;
        ++kept;
      } else {
        missed_by_means += least < 2e-3 * (1 - 1e-3);
      }
    }
  }
  EXPECT_EQ(kept, 3);
  EXPECT_GT(missed_by_means, 0);
}

// Springs of a sheet without shifts do not change: what is left of their energy is rounding.
TEST_F(Optimising, StillSpringsRestNowhere) {
  const Sheet own(solver_, next_start(false)), still(solver_, 0 * own.shifts_mm());
  EnergyModel::Options options;
  const auto equilibria = [&](const Sheet& sheet) {
    return find_equilibria(EnergyModel(sheet, options));
  };
  EXPECT_EQ(equilibria(still).size(), 0u);
  EXPECT_GT(equilibria(own).size(), 0u);
  options.joints.stiffness_n_mm_per_mm = 1e-3;
  ASSERT_EQ(equilibria(still).size(), 1u) << "its hinges are relaxed flat";
  EXPECT_EQ(equilibria(still)[0].x, 0);
}

// Where a sheet is folded flat nothing moves it, but springs hold energy: against the distances of
// its folded vertices.
TEST_F(Optimising, SpringsHoldEnergyAtFlatFoldedEnds) {
  const DrawableSheet large(6, 6);
  const Model model(large.base);
  SheetSolver solver(model);
  int flat_folded = 0;
  for (unsigned seed = 1; seed <= 60 && flat_folded == 0; ++seed) {
    const Sheet sheet(solver, member_of(large.base, 1, true, seed));
    if (sheet.deploys_from_deg() < 180) continue;
    ReleaseOptions deploying;
    deploying.from_deg = 180;
    double n_mm = 0;
    for (const Diagonal& diagonal : sheet.mechanism().diagonals) {
      const auto length_mm = [&](const auto& at_mm) {
        return (at_mm.col(diagonal.to) - at_mm.col(diagonal.from)).norm();
      };
      const double longer_mm = length_mm(sheet.shapes_mm()[179]) - length_mm(sheet.vertices_mm());
      n_mm += deploying.sheet.springs().stiffness_n_per_mm * longer_mm * longer_mm / 2;
    }
    EXPECT_NEAR(springs_n_mm(sheet, deploying).value() / n_mm, 1, 1e-6) << "seed " << seed;
    ++flat_folded;
  }
  EXPECT_GT(flat_folded, 0);
}

// An unshifted sheet deploys from no angle, so its history has no row up to D.
TEST_F(Optimising, SpringsHoldNoEnergyWhereASheetDeploysFromNoAngle) {
  const DrawableSheet large(6, 6);
  const OwnSheet still(large.base, Eigen::Matrix2Xd::Zero(2, large.base.sheet.vertex_count()));
  ASSERT_EQ(still.sheet.deploys_from_deg(), 0);
  ReleaseOptions deploying;
  deploying.from_deg = 0;
  EXPECT_EQ(springs_n_mm(still.sheet, deploying), std::nullopt);
}

// On a cutter's grid every end's shifts are whole multiples of it.
TEST_F(Optimising, KeepsToAGrid) {
  options_.grid_mm = 0.05;
  for (int trial = 0; trial < 3; ++trial) {
    const Optimised found = *optimise(Sheet(solver_, next_start(true)), options_);
    EXPECT_GT(found.best().value, found.start().value);
    EXPECT_EQ(found.best().value, friction(found.best().shifts_mm));
    for (const double shift_mm : found.best().shifts_mm.reshaped()) {
      EXPECT_EQ(std::round(shift_mm / 0.05) * 0.05, shift_mm);
      EXPECT_LE(std::abs(shift_mm), 0.4 * (1 + 1e-12));
    }
  }
  EXPECT_EQ(optimise(Sheet(solver_, next_start(false)), options_).fault()->name, "grid_mm");
}

// Among the members of a parallel family, which fold to 180 degrees whatever the coordinates.
TEST_F(Optimising, MovesWithinAFamily) {
  const DrawableSheet large(6, 6);
  const Model model(large.base);
  SheetSolver solver(model);
  const ParallelFamily family = family_with_rim(large.base);
  options_.shifted = family.vertices();
  options_.moves = family.basis();
  options_.deploys_from_sample = 178;
  options_.amplitude_mm = 2;
  const Matrix2Xd start = member_of(large.base, 1, true, 7);
  ASSERT_LE(parallel_misfit(large.base, start).mm, kMemberWithin_mm);
  const Optimised found = *optimise(Sheet(solver, start), options_);
  EXPECT_GT(found.best().value, 1.5 * found.start().value);
  EXPECT_LE(parallel_misfit(large.base, found.best().shifts_mm).mm, kMemberWithin_mm);
  EXPECT_LE(found.best().shifts_mm.cwiseAbs().maxCoeff(), 2 * (1 + 1e-15));
  EXPECT_GE(Sheet(solver, found.best().shifts_mm).history().verdict.deploys_from_sample, 178);
}

// The margin is that of catalogues, and the local model begins with it.
TEST_F(Optimising, MarginsAgainstMiscutsGrow) {
  const Model model(base_.base, base_.shifted_vertices, {}, 150);
  SheetSolver solver(model);
  options_.goal = goal_named("miscut_margin_mm");
  for (int trial = 0; trial < 3; ++trial) {
    const Matrix2Xd shifts_mm = next_start(false);
    const Sheet start(solver, shifts_mm);
    const LocalModel local = *local_model(start, options_);
    EXPECT_NEAR(local.goal(VectorXd::Zero(local.coordinates)) / *start.record().miscut_margin_mm, 1,
                1e-6);
    const Optimised found = *optimise(start, options_);
    EXPECT_GT(found.best().value, 2 * found.start().value);
    EXPECT_EQ(found.best().value, *Sheet(solver, found.best().shifts_mm).record().miscut_margin_mm);
  }
  EXPECT_EQ(optimise(Sheet(solver_, next_start(false)), options_).fault()->name, "goal");
}

// Another goal that is not to fall: kept by every step, and priced at the end.
TEST_F(Optimising, KeepsFloors) {
  const Model model(base_.base, base_.shifted_vertices, {}, 150);
  SheetSolver solver(model);
  int priced = 0;
  for (int trial = 0; trial < 3; ++trial) {
    const Sheet start(solver, next_start(false));
    const double margin_mm = *start.record().miscut_margin_mm;
    options_.floors = {{goal_named("miscut_margin_mm"), 0.999 * margin_mm}};
    const Optimised found = *optimise(start, options_);
    EXPECT_GT(found.best().value, found.start().value);
    for (const Optimised::Taken& step : found.taken) {
      EXPECT_GE(*Sheet(solver, step.shifts_mm).record().miscut_margin_mm, 0.999 * margin_mm);
    }
    if (found.limits) priced += found.limits->per_floor.at(0) > 0;
    // The other way round.
    OptimiseOptions other = options_;
    other.goal = goal_named("miscut_margin_mm");
    other.floors = {{goal_named("critical_friction_n_mm_per_mm"), found.start().value}};
    const Optimised wide = *optimise(start, other);
    EXPECT_GT(wide.best().value, margin_mm);
    EXPECT_GE(friction(wide.best().shifts_mm), found.start().value);
    options_.floors = {{goal_named("miscut_margin_mm"), 1.001 * margin_mm}};
    EXPECT_EQ(optimise(start, options_).fault()->name, "subject_to");
  }
  EXPECT_GT(priced, 0) << "a margin that limits has its price";
}

// What a certificate wants, against lengths at close angles: draws are judged by whole degrees.
TEST_F(Optimising, SeesWhatTurnsBackBetweenSamples) {
  int straight = 0, turning = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Sheet sheet(solver_, next_start(trial % 2 == 0));
    const FoldingWay& way = *sheet.way();
    constexpr double kClose_deg = 0.01;
    double least_mm = 1, fold_rad = 0;
    Eigen::VectorXd last_mm = way.flat_mm(), total_mm, lengths_mm, rates;
    way.find_lengths(way.x_of(150), total_mm, rates);
    for (int k = 1; k * kClose_deg <= 150 + 1e-9; ++k) {
      way.find_lengths(way.x_of(std::min(150.0, k * kClose_deg)), lengths_mm, rates);
      for (Eigen::Index d = 0; d < last_mm.size(); ++d) {
        const double side = total_mm(d) < way.flat_mm()(d) ? -1 : 1;
        least_mm = std::min(least_mm, side * (lengths_mm(d) - last_mm(d)));
      }
      last_mm = lengths_mm;
    }
    way.find_creases(way.x_of(150), lengths_mm, rates);
    fold_rad = lengths_mm.cwiseAbs().maxCoeff();
    // Turns within less than a step of 150 degrees, and creases all but flat, are for neither side.
    if (std::abs(least_mm) < 1e-9 || std::abs(fold_rad - M_PI) < 1e-5) continue;
    const bool goes = least_mm > 0 && fold_rad < M_PI;
    ++(goes ? straight : turning);
    EXPECT_EQ(goes_all_the_way(sheet, options_), goes)
        << "seed " << seed_ << ", trial " << trial << ", " << least_mm << " mm";
  }
  EXPECT_GT(straight, 20);
  EXPECT_GT(turning, 0);
}

TEST_F(Optimising, RefusesWhatDoesNotFit) {
  const Matrix2Xd start = next_start(true);
  const Sheet sheet(solver_, start);
  const auto fault_of = [&](auto change) {
    OptimiseOptions options = options_;
    change(options);
    return optimise(sheet, options).fault()->name;
  };
  EXPECT_EQ(fault_of([](OptimiseOptions& o) { o.amplitude_mm = 0.3; }), "amplitude_mm");
  EXPECT_EQ(fault_of([](OptimiseOptions& o) { o.amplitude_mm = 0.5, o.ternary = true; }),
            "amplitude_mm");
  EXPECT_EQ(fault_of([](OptimiseOptions& o) { o.deploys_from_sample = 180; }), "deploys_from_deg");
  EXPECT_EQ(fault_of([](OptimiseOptions& o) { o.stroke_limit = 1e-6; }), "stroke_limit");
  EXPECT_EQ(fault_of([](OptimiseOptions& o) { o.largest_force_n = 1e-6; }), "largest_force_n");
  EXPECT_EQ(fault_of([](OptimiseOptions& o) { o.deploying.from_deg = 179.99; }), "from_deg");
  const Sheet correct(solver_, 0 * start);
  EXPECT_EQ(optimise(correct, options_).fault()->name, "deploys_from_deg");
  EXPECT_EQ(fault_of([](OptimiseOptions& o) {
              o.goal = goal_named("static_friction_n_mm_per_mm");
              o.deploying.sheet.springs().preload.each_n = 5;  // panels give way to it
            }),
            "goal");
}

}  // namespace
}  // namespace misalign::solver
