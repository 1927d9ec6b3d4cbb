// Goals that springs decide which are chosen for each sheet, against choices made anew.
#include "solver/bending/preload.hpp"
#include "solver/optimise/chosen_friction.hpp"
#include "solver/optimise/goal_functions.hpp"
#include "solver/optimise/objective.hpp"
#include "tests/solver/optimise/goals.hpp"

namespace misalign::solver {
namespace {

using Eigen::Matrix2Xd;
using Eigen::VectorXd;

class GoalsOfSprings : public Goals {};

// The friction of the best springs, against that of sheets next to it for which springs are chosen
// anew. Its gradient leaves out that of the creases' turning: the shifts' share of a panel's width,
// some thousandths of a change that is as large as the friction itself for some tenths of a mm.
TEST_F(GoalsOfSprings, TheBestSpringsGiveWayToFirstOrder) {
  options_.bending.to_deg = 1;
  for (int trial = 0; trial < 3; ++trial) {
    const Matrix2Xd shifts_mm = next_start();
    const Sheet start(solver_, shifts_mm);
    const auto choice = choose_springs(start, choice_of(options_.deploying, 1));
    ASSERT_TRUE(choice && choice->drives());
    SheetChanges changes(start, options_);
    const std::vector<GoalTerm> terms = local_chosen_friction(changes);
    ASSERT_EQ(terms.size(), choice->rows.size());
    VectorXd row = VectorXd::Zero(terms.front().row.size());
    double friction = 0;
    for (const ProgrammedSprings::Weight& weight : choice->weights) {
      for (std::size_t k = 0; k < terms.size(); ++k) {
        if (choice->rows[k].pilot_deg != weight.pilot_deg) continue;
        row += weight.weight / terms[k].divisor * terms[k].row;
        friction += weight.weight * terms[k].numerator / terms[k].divisor;
      }
    }
    EXPECT_NEAR(friction / choice->static_n_mm_per_mm, 1, 1e-6);
    constexpr double kStep_mm = 1e-4;
    for (const VectorXd& along :
         {VectorXd(row.normalized()), VectorXd(row.unaryExpr([&](double) {
                                        return static_cast<double>(random_() % 1000) / 500 - 1;
                                      }))
                                          .normalized()
                                          .eval()}) {
      double change = 0;
      for (const double sign : {-1.0, 1.0}) {
        Matrix2Xd changed_mm = shifts_mm;
        for (Eigen::Index k = 0; k < along.size(); ++k) {
          changed_mm(k % 2, options_.shifted[static_cast<std::size_t>(k / 2)]) +=
              sign * kStep_mm * along(k);
        }
        change += sign * *chosen_friction_n_mm_per_mm(Sheet(solver_, changed_mm), options_);
      }
      EXPECT_NEAR(change / (2 * kStep_mm), row.dot(along), 0.02 * row.norm())
          << "seed " << seed_ << ", trial " << trial;
    }
  }
}

// Ascents with springs that are chosen for each sheet, from starts that equal springs drive, too.
TEST_F(GoalsOfSprings, SheetsAreFoundForTheirBestSprings) {
  options_.most_steps = 12;
  int better = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Sheet start(solver_, next_start());
    options_.goal = goal_named("critical_friction_n_mm_per_mm");
    const Optimised equal = *optimise(start, options_);
    options_.goal = goal_named("chosen_friction_n_mm_per_mm");
    const Optimised chosen = *optimise(start, options_);
    EXPECT_GT(chosen.best().value, chosen.start().value);
    const Sheet end(solver_, equal.best().shifts_mm);
    better += chosen.best().value > *chosen_friction_n_mm_per_mm(end, options_);
    // The springs of the optimum, let go: their energy takes the friction of every turn.
    const Sheet best(solver_, chosen.best().shifts_mm);
    ReleaseOptions let_go = options_.deploying;
    let_go.sheet.fill =
        choose_springs(best, choice_of(let_go, options_.bending.to_deg))->filling(best.mechanism());
    EXPECT_GE(friction(best, let_go), chosen.best().value * (1 - 1e-3));
  }
  EXPECT_GE(better, 3);
}

// Springs within their limits: at least as good as without, and no stronger than they may be.
TEST_F(GoalsOfSprings, SpringsAreChosen) {
  for (int trial = 0; trial < 2; ++trial) {
    const Sheet start(solver_, next_start());
    options_.goal = goal_named("critical_friction_n_mm_per_mm");
    options_.stiffness_n_per_mm.reset();
    options_.largest_force_n = 20;
    springs() = {};
    if (!is_strong_enough(start, options_)) continue;
    options_.stiffness_n_per_mm = {10, 500};
    const Optimised chosen = *optimise(start, options_);
    EXPECT_GT(chosen.best().value, chosen.start().value);
    const Sheet end(solver_, chosen.best().shifts_mm);
    OptimiseOptions there = options_;
    const auto set_rate = [&](double n_per_mm) {
      set_springs(there, {chosen.best().shifts_mm, n_per_mm, 0});
    };
    const double n_per_mm = chosen.best().stiffness_n_per_mm;
    set_rate(n_per_mm);
    EXPECT_TRUE(is_strong_enough(end, there));
    EXPECT_EQ(*value_of(*options_.goal, end, there), chosen.best().value);
    // On its own the rate is as large as the springs bear: friction goes with it.
    set_rate(1.03 * n_per_mm);
    EXPECT_FALSE(is_strong_enough(end, there)) << n_per_mm;

    // A preload, of which there is a best one: panels give way to more.
    options_.goal = goal_named("static_friction_n_mm_per_mm");
    options_.largest_force_n.reset();
    options_.stiffness_n_per_mm.reset();
    springs().preload.each_n = 0.005;
    options_.preload_n = {0, 5};
    const Optimised pulled = *optimise(start, options_);
    EXPECT_GT(pulled.best().value, pulled.start().value);
    const Sheet taut(solver_, pulled.best().shifts_mm);
    for (const double share : {0.8, 1.25}) {
      set_springs(there, {pulled.best().shifts_mm, springs().stiffness_n_per_mm,
                          share * pulled.best().preload_n});
      EXPECT_LT(*value_of(*options_.goal, taut, there), pulled.best().value) << share;
    }
    options_.preload_n.reset();
  }
}

}  // namespace
}  // namespace misalign::solver
