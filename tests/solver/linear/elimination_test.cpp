// The fixed-order elimination and its factors, against Eigen's dense LU.
#include <Eigen/LU>
#include <numeric>
#include <random>
#include <set>

#include "solver/continuation/path_follower.hpp"
#include "solver/linear/newton.hpp"
#include "solver/linear/pivot_order.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Vector = Eigen::VectorXd;

constexpr std::pair<int, int> kShapes[] = {{4, 4},   {6, 6},   {8, 6},  {8, 8},
                                           {10, 10}, {14, 14}, {20, 20}};

// Of the large ones fewer states: the dense matrices they are compared with are what takes time.
int states_of(int rows) { return rows <= 10 ? 50 : rows <= 14 ? 4 : 1; }

// A sheet at a random state: misaligned by up to 0.4 mm, every joint up to 5 % of the way to flat
// or closed off the base folding; and its Jacobian, sparsely factored and dense.
class RandomSystem {
 public:
  RandomSystem(int rows, int columns)
      : sheet_(rows, columns),
        plan_(
            plan_elimination(sheet_.mechanism, sheet_.base.folding, sheet_.base.sheet.vertices_mm)),
        lu_(plan_),
        system_(sheet_.mechanism) {}

  const Mechanism& mechanism() const { return sheet_.mechanism; }
  const Elimination& plan() const { return plan_; }
  const SparseLu<double>& lu() const { return lu_; }
  /// n x (n + 1), the pilot's column last.
  const Eigen::MatrixXd& jacobian() const { return system_.jacobian(); }

  void draw(double pilot_deg, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    FlatVertices vertices = sheet_.base.sheet.vertices_mm;
    for (double& x : vertices.reshaped()) x += 0.4 * uniform(random);
    SheetGeometry<double> geometry;
    place(mechanism(), vertices, geometry);
    FoldState<double> state = sheet_.folded(pilot_deg);
    const HalfAngle<double> pilot = state.creases[mechanism().pilot];
    std::vector<double> turn(mechanism().unknowns), residual(mechanism().equations);
    for (double& angle : turn) angle = 0.05 * pilot.s * pilot.c * uniform(random);
    advance(mechanism(), turn.data(), state);
    system_.evaluate(geometry, state);
    values_.resize(jacobian_entries(mechanism()).size());
    evaluate(mechanism(), geometry, state, residual.data(), values_.data());
    write_values();
    lu_.factorize();
  }

  /// Once more, with a right-hand side on the way: L^-1 of it.
  Vector factorized_with(const Vector& rhs) {
    Vector y(rhs.size() + 1);
    write_values();
    lu_.factorize(rhs.data(), y.data());
    return y;
  }

  /// x with J x = rhs, the pilot held or else the partner.
  Vector solve(const Vector& rhs, bool hold_pilot) const {
    const Eigen::Index n = rhs.size();
    Vector y(n + 1), x(n + 1);
    lu_.forward(rhs.data(), y.data());
    const double rest = y[n - 1];
    lu_.backward(y.data(), hold_pilot ? rest / lu_.partner_coefficient() : 0.0,
                 hold_pilot ? 0.0 : rest / lu_.pilot_coefficient(), x.data());
    return x;
  }

 private:
  void write_values() {
    auto entry = lu_.entries();
    for (const double value : values_) *entry++ = value;
  }

  TestSheet sheet_;
  Elimination plan_;
  SparseLu<double> lu_;
  ClosureSystem system_;
  std::vector<double> values_;
};

// From 1 to 179 degrees; every other one logarithmically near flat or near closed.
double random_angle_deg(int trial, std::mt19937_64& random) {
  const double share = std::uniform_real_distribution<double>(0, 1)(random);
  if (trial % 4 == 1) return std::pow(90, share);
  if (trial % 4 == 3) return 180 - std::pow(90, share);
  return 1 + 178 * share;
}

// Calls check(system, random) at random states of every shape.
template <class Check>
void at_random_states(Check&& check) {
  std::mt19937_64 random(20160235);
  for (const auto& [rows, columns] : kShapes) {
    SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
    RandomSystem system(rows, columns);
    for (int trial = 0; trial < states_of(rows); ++trial) {
      const double pilot_deg = random_angle_deg(trial, random);
      SCOPED_TRACE("pilot at " + std::to_string(pilot_deg) + " degrees");
      system.draw(pilot_deg, random);
      check(system, random);
    }
  }
}

Vector random_vector(Eigen::Index n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Vector::NullaryExpr(n, [&] { return uniform(random); });
}

// Of a vector its largest entry.
double norm_of(const Eigen::MatrixXd& matrix) {
  return matrix.cwiseAbs().rowwise().sum().maxCoeff();
}

// The plan is tried out to 1e-11 at twenty states; at the 255 here the worst is 6e-13 (of a null
// vector; 2e-13 of a solution).
constexpr double kBackwardError = 1e-11;

// |x - Eigen's x| over |x|, times Eigen's inverse condition number: the worst is 5e-16.
constexpr double kForwardError = 1e-14;

// Eigen's matrix has the partner's column in its place, or the pilot's where the partner is held.
void compare_solutions(bool hold_pilot) {
  double worst_backward = 0, worst_forward = 0;
  at_random_states([&](const RandomSystem& system, std::mt19937_64& random) {
    const int n = system.mechanism().equations;
    const int partner = system.plan().partner();
    const int held = hold_pilot ? n : partner, free = hold_pilot ? partner : n;
    const Vector rhs = random_vector(n, random);
    Vector x = system.solve(rhs, hold_pilot);
    EXPECT_EQ(x[held], 0);
    EXPECT_NE(x[free], 0);
    const Eigen::MatrixXd& jacobian = system.jacobian();
    const double backward =
        norm_of(jacobian * x - rhs) / (norm_of(jacobian) * norm_of(x) + norm_of(rhs));
    EXPECT_LE(backward, kBackwardError);

    Eigen::MatrixXd square = jacobian.leftCols(n);
    square.col(partner) = jacobian.col(free);
    x[partner] = x[free];
    const Eigen::PartialPivLU<Eigen::MatrixXd> dense(square);
    const Vector expected = dense.solve(rhs);
    const double forward = norm_of(x.head(n) - expected) / norm_of(expected) * dense.rcond();
    EXPECT_LE(forward, kForwardError);
    worst_backward = std::max(worst_backward, backward);
    worst_forward = std::max(worst_forward, forward);
  });
  testing::Test::RecordProperty("worst_backward_error", scientific(worst_backward));
  testing::Test::RecordProperty("worst_forward_error_over_condition", scientific(worst_forward));
}

TEST(SparseLu, SolvesAsEigenDoesWithThePilotHeld) { compare_solutions(true); }

TEST(SparseLu, SolvesAsEigenDoesWithThePartnerHeld) { compare_solutions(false); }

TEST(SparseLu, NullVectorIsTheTangent) {
  double worst = 0;
  at_random_states([&](const RandomSystem& system, std::mt19937_64&) {
    const Eigen::Index n = system.mechanism().equations;
    Vector work(n + 1), tangent(n + 1);
    system.lu().null_vector(-system.lu().pilot_coefficient(), system.lu().partner_coefficient(),
                            work.data(), tangent.data());
    ASSERT_GT(norm_of(tangent), 0);
    const double open = norm_of(Vector(system.jacobian() * tangent)) /
                        (norm_of(system.jacobian()) * norm_of(tangent));
    EXPECT_LE(open, kBackwardError);
    worst = std::max(worst, open);
  });
  RecordProperty("worst_open_by", scientific(worst));
}

TEST(SparseLu, KnowsTheSignOfTheDeterminant) {
  int negative = 0;
  at_random_states([&](const RandomSystem& system, std::mt19937_64&) {
    const int n = system.mechanism().equations;
    const Eigen::PartialPivLU<Eigen::MatrixXd> dense(system.jacobian().leftCols(n));
    int expected = dense.permutationP().determinant() > 0 ? 1 : -1;
    int sign = system.plan().permutation_sign;
    for (int k = 0; k < n; ++k) {
      if (dense.matrixLU()(k, k) < 0) expected = -expected;
      if (system.lu().pivot(k) < 0) sign = -sign;
    }
    EXPECT_EQ(sign, expected);
    negative += expected < 0;
  });
  EXPECT_GT(negative, 0) << "one sign only: the test shows nothing";
  EXPECT_LT(negative, 255);
}

Elimination plan_of(const TestSheet& sheet) {
  return plan_elimination(sheet.mechanism, sheet.base.folding, sheet.base.sheet.vertices_mm);
}

std::vector<int> sorted(std::vector<int> values) {
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<int> count_up_to(int n) {
  std::vector<int> values(n);
  std::iota(values.begin(), values.end(), 0);
  return values;
}

TEST(Elimination, EveryValueHasOneSlotAndEverySlotOneUse) {
  for (const auto& [rows, columns] : kShapes) {
    const TestSheet sheet(rows, columns);
    const Elimination plan = plan_of(sheet);
    EXPECT_EQ(plan.slot_of_value.size(), jacobian_entries(sheet.mechanism).size());
    std::vector<int> slots(plan.slot_of_value.begin(), plan.slot_of_value.end());
    slots.insert(slots.end(), plan.fill_slots.begin(), plan.fill_slots.end());
    EXPECT_EQ(sorted(slots), count_up_to(plan.slots));
  }
}

// A value's slot lies in the row and column where the orders put it.
TEST(Elimination, SlotsFollowTheOrders) {
  for (const auto& [rows, columns] : kShapes) {
    const TestSheet sheet(rows, columns);
    const Elimination plan = plan_of(sheet);
    const int n = sheet.mechanism.equations;
    EXPECT_EQ(plan.equations, n);
    EXPECT_EQ(sorted(plan.row_of), count_up_to(n));
    EXPECT_EQ(sorted(plan.column_of), count_up_to(n + 1));
    ASSERT_EQ(static_cast<int>(plan.pivots.size()), n);
    const std::vector<JacobianEntry> entries = jacobian_entries(sheet.mechanism);
    for (std::size_t e = 0; e < entries.size(); ++e) {
      const std::int32_t slot = plan.slot_of_value[e];
      EXPECT_EQ(plan.column_of[plan.column[slot]], entries[e].column);
      int row = 0;
      while (plan.pivots[row].upper.end <= slot) ++row;
      EXPECT_EQ(plan.row_of[row], entries[e].row);
    }
    for (int k = 0; k < n; ++k) {
      EXPECT_EQ(plan.column[plan.pivots[k].slot], k);
      EXPECT_EQ(plan.pivots[k].upper.begin, plan.pivots[k].slot + 1);
    }
  }
}

// Held in turn, they must tell two sides of a fold limit apart: a neighbour would turn with the
// pilot.
TEST(Elimination, ThePilotIsLastAndItsPartnerACreaseElsewhere) {
  for (const auto& [rows, columns] : kShapes) {
    const TestSheet sheet(rows, columns);
    const Mechanism& mechanism = sheet.mechanism;
    const Elimination plan = plan_of(sheet);
    const Crease& pilot = mechanism.creases[mechanism.pilot];
    EXPECT_EQ(plan.column_of.back(), pilot.column);
    const auto partner =
        std::find_if(mechanism.creases.begin(), mechanism.creases.end(),
                     [&](const Crease& crease) { return crease.column == plan.partner(); });
    ASSERT_NE(partner, mechanism.creases.end());
    for (const int vertex : {partner->a, partner->b}) {
      EXPECT_NE(vertex, pilot.a);
      EXPECT_NE(vertex, pilot.b);
    }
  }
}

// The definition: one pivot after another on a dense matrix, every slot in the same order. Blocks
// of pivots, the right-hand side on the way and two solutions in one pass keep its bits.
TEST(SparseLu, BitsAreThoseOfOnePivotAfterAnother) {
  std::mt19937_64 random(7);
  for (const auto& [rows, columns] : {std::pair(6, 6), {10, 10}, {14, 14}}) {
    RandomSystem system(rows, columns);
    const Elimination& plan = system.plan();
    const int n = plan.equations;
    const auto is_block = [](const Elimination::Block& block) { return block.size() > 1; };
    EXPECT_TRUE(rows == 6 || std::any_of(plan.blocks.begin(), plan.blocks.end(), is_block));
    system.draw(70, random);
    Eigen::MatrixXd a(n, n + 1);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j <= n; ++j) a(i, j) = system.jacobian()(plan.row_of[i], plan.column_of[j]);
    }
    const Vector rhs = random_vector(n, random);
    Vector y = rhs(plan.row_of);
    for (int k = 0; k < n; ++k) {
      const double inverse = 1 / a(k, k);
      for (int i = k + 1; i < n; ++i) {
        const double factor = a(i, k) * inverse;
        for (int j = k + 1; j <= n; ++j) a(i, j) -= factor * a(k, j);
        y[i] -= factor * y[k];
      }
    }
    Vector forward(n + 1), x(n + 1), null(n + 1), work(n + 1), x_alone(n + 1), null_alone(n + 1);
    system.lu().forward(rhs.data(), forward.data());
    EXPECT_EQ(forward.head(n), y);
    EXPECT_EQ(system.factorized_with(rhs).head(n), y);
    const double partner = y[n - 1] / a(n - 1, n - 1);
    Vector used = forward;
    system.lu().backward(used.data(), partner, 0.0, x_alone.data());
    system.lu().null_vector(-a(n - 1, n), a(n - 1, n - 1), work.data(), null_alone.data());
    system.lu().backward_with_null_vector(forward.data(), partner, 0.0, x.data(), -a(n - 1, n),
                                          a(n - 1, n - 1), work.data(), null.data());
    EXPECT_EQ(x, x_alone);
    EXPECT_EQ(null, null_alone);
    EXPECT_EQ(system.lu().pilot_coefficient(), a(n - 1, n));
    for (int k = 0; k < n; ++k) EXPECT_EQ(system.lu().pivot(k), a(k, k)) << k;
  }
}

// Markowitz' order alone takes 1,004,572 on 20 x 20, within the parts of a dissection along x and y
// half of that, 337,000 with oblique cuts; 6,945,562 and 4.1 million on 40 x 40. The paper's size
// was 2,043 with pivots above 0.01 of their column, 1,712 with those above 0.0003.
TEST(Elimination, OperationsStayFew) {
  EXPECT_LE(plan_of(TestSheet(6, 6)).operations(), 1900u);
  EXPECT_LE(plan_of(TestSheet(20, 20)).operations(), 360'000u);
  EXPECT_LE(plan_of(TestSheet(40, 40)).operations(), 4'360'000u);
}

// Nothing depends on addresses, hashes or what ran before.
TEST(Elimination, TwoPlansOfASheetAreEqual) {
  const Elimination a = plan_of(TestSheet(8, 6)), b = plan_of(TestSheet(8, 6));
  EXPECT_EQ(a.row_of, b.row_of);
  EXPECT_EQ(a.column_of, b.column_of);
  EXPECT_EQ(a.permutation_sign, b.permutation_sign);
  EXPECT_EQ(a.slot_of_value, b.slot_of_value);
  EXPECT_EQ(a.fill_slots, b.fill_slots);
  EXPECT_EQ(a.column, b.column);
  EXPECT_EQ(a.lower_slot, b.lower_slot);
  EXPECT_EQ(a.targets, b.targets);
}

struct OneRun {
  PathResult result{};

  bool see(const Station&, int) { return true; }
  void ended(const PathResult& path, int) { result = path; }
};

// Symmetry makes minors vanish there: the paths stalled at 90.000000 degrees.
TEST(SparseLu, UnshiftedLargeSheetsFoldBeyond90Degrees) {
  for (const int panels : {16, 20}) {
    const TestSheet sheet(panels, panels);
    const Elimination elimination = plan_of(sheet);
    PathFollower<double> follower(sheet.mechanism, elimination);
    const PathPlan plan = sheet.plan({.end_deg = 100});
    OneRun run;
    follower.follow({&sheet.geometry, &plan.start, &plan}, run);
    EXPECT_EQ(run.result.end, PathEnd::end_reached) << panels;
  }
}

// Pivots chosen on open states only are zero where every loop closes: on this sheet 351 and 93
// iterations went by before the path was given up. Three or four a station are Newton's own.
TEST(SparseLu, NewtonConvergesOnALargeMisalignedSheet) {
  const TestSheet sheet(28, 28);
  const Elimination elimination = plan_of(sheet);
  std::mt19937 random(99);
  FlatVertices vertices = sheet.base.sheet.vertices_mm;
  for (int i = 1; i < 28; ++i) {
    for (int j = 1; j < 28; ++j) {
      for (double& x : vertices.col(29 * i + j)) x += 0.4 * (static_cast<int>(random() % 3) - 1);
    }
  }
  SheetGeometry<double> geometry;
  place(sheet.mechanism, vertices, geometry);
  PathFollower<double> follower(sheet.mechanism, elimination);
  for (const int first_deg : {1, 60}) {
    PathPlan plan{{}, sheet.folded(first_deg)};
    for (int k = first_deg; k <= first_deg + 5; ++k) {
      plan.stations.push_back({1.0 * k, half_angle_of_deg(k), k, true});
    }
    OneRun path;
    follower.follow({&geometry, &plan.start, &plan}, path);
    EXPECT_EQ(path.result.end, PathEnd::end_reached);
    EXPECT_EQ(path.result.arc_steps, 0);
    EXPECT_LE(path.result.newton_iterations, 4 * path.result.newton_solves);
  }
}

}  // namespace
}  // namespace misalign::solver
