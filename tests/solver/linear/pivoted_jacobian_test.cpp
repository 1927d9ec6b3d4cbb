// Factors with pivoting, sparse on large sheets, against Eigen's dense LU and dense null vectors.
#include "solver/linear/pivoted_jacobian.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <functional>
#include <limits>
#include <set>

#include "solver/continuation/path_follower.hpp"
#include "solver/linear/pivoted_closure.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The Jacobian without one column.
MatrixXd without(const MatrixXd& jacobian, Eigen::Index column) {
  MatrixXd square(jacobian.rows(), jacobian.rows());
  square << jacobian.leftCols(column), jacobian.rightCols(jacobian.rows() - column);
  return square;
}

int sign_of_determinant(const MatrixXd& matrix) {
  const Eigen::PartialPivLU<MatrixXd> lu(matrix);
  int sign = static_cast<int>(lu.permutationP().determinant());
  for (const double pivot : lu.matrixLU().diagonal()) sign = pivot < 0 ? -sign : sign;
  return sign;
}

// 307 unknowns: sparse.
class LargeSheet : public ::testing::Test {
 protected:
  LargeSheet() {
    const ShiftBlock block = sheet_.draws(1, kSeed);
    place(sheet_.mechanism, sheet_.vertices(block, 0), geometry_);
  }

  const DrawableSheet sheet_{12, 12};
  SheetGeometry<double> geometry_;
};

TEST_F(LargeSheet, FactorsSolveBothWaysAndKnowTheSign) {
  ClosureSystem system(sheet_.mechanism);
  ASSERT_TRUE(PivotedJacobian::is_sparse(sheet_.mechanism));
  PivotedJacobian factors(system);
  const int pilot = sheet_.mechanism.equations;
  srand(12);
  std::set<int> signs;
  for (const double pilot_deg : {0.1, 1.0, 60.0, 170.0, 179.9}) {
    system.evaluate(geometry_, sheet_.folded(pilot_deg));
    for (const int held : {pilot, 0, 1, 200, pilot}) {
      const MatrixXd square = without(system.jacobian(), held);
      const VectorXd rhs = VectorXd::Random(square.rows());
      factors.factorize(held);
      // Residuals of a stable elimination are some rounding errors of the sums.
      const VectorXd x = factors.solve(rhs), y = factors.solve_transposed(rhs);
      EXPECT_LE((square * x - rhs).norm(), 1e-12 * square.norm() * x.norm()) << pilot_deg;
      EXPECT_LE((square.transpose() * y - rhs).norm(), 1e-12 * square.norm() * y.norm());
      const int sign = sign_of_determinant(square);
      EXPECT_EQ(factors.determinant_sign(), sign) << "held " << held << " at " << pilot_deg;
      signs.insert(sign);
    }
  }
  EXPECT_EQ(signs.size(), 2U) << "both signs are met";
}

TEST_F(LargeSheet, FactorsOfASingularMatrixGiveNoNumbers) {
  ClosureSystem system(sheet_.mechanism);
  PivotedJacobian factors(system);
  FoldState<double> state = sheet_.folded(60);
  state.creases[0].c = std::numeric_limits<double>::quiet_NaN();
  system.evaluate(geometry_, state);
  factors.factorize();
  EXPECT_FALSE(factors.solve(VectorXd::Ones(sheet_.mechanism.equations)).allFinite());
}

TEST_F(LargeSheet, ClosureSolvesWithThePilotHeldAndFree) {
  ClosureSystem system(sheet_.mechanism);
  PivotedClosure closure(system);
  const Eigen::Index unknowns = sheet_.mechanism.unknowns, pilot = unknowns - 1;
  VectorXd x(unknowns), null(unknowns);
  for (const double pilot_deg : {1.0, 60.0, 170.0, 179.9, 179.9}) {
    closure.linearize(geometry_, sheet_.folded(pilot_deg));
    for (const double is_free : {0.0, 1.0}) {
      closure.solve(is_free, x.data(), null.data());
      const MatrixXd& jacobian = system.jacobian();
      EXPECT_LE((jacobian * x - system.residual()).norm(), 1e-12 * jacobian.norm() * x.norm());
      EXPECT_LE((jacobian * null).norm(), 1e-12 * jacobian.norm() * null.norm());
      if (is_free == 0) {
        EXPECT_EQ(x[pilot], 0);
      }
      MatrixXd with_tangent(unknowns, unknowns);
      with_tangent << jacobian, null.transpose();
      EXPECT_EQ(closure.orientation(), sign_of_determinant(with_tangent)) << pilot_deg;
    }
  }
}

// Ends of paths, at limits too, and the states on the way.
struct Seen {
  bool see(const Station& station, int) {
    stations.push_back(station.pilot_deg);
    states.push_back(follower_state());
    return true;
  }
  void ended(const PathResult& result, int) { path = result; }

  std::function<FoldState<double>()> follower_state;
  std::vector<double> stations;
  std::vector<FoldState<double>> states;
  PathResult path{};
};

// The same for a follower from a QR decomposition of the transposed Jacobian: its last column is
// the null vector, the others give the shortest correction.
class DenseNullSpace {
 public:
  explicit DenseNullSpace(ClosureSystem& system) : system_(system) {}

  void restart(int) {}
  double linearize(const SheetGeometry<double>& geometry, const FoldState<double>& state) {
    const double open_by = system_.evaluate(geometry, state);
    const Eigen::HouseholderQR<MatrixXd> qr(system_.jacobian().transpose());
    const Eigen::Index equations = system_.residual().size();
    VectorXd step = VectorXd::Zero(equations + 1);
    step.head(equations) =
        qr.matrixQR().topRows(equations).triangularView<Eigen::Upper>().transpose().solve(
            system_.residual());
    shortest_ = qr.householderQ() * step;
    null_ = qr.householderQ() * VectorXd::Unit(equations + 1, equations);
    MatrixXd bordered(equations + 1, equations + 1);
    bordered << system_.jacobian(), null_.transpose();
    sign_ = sign_of_determinant(bordered);
    return open_by;
  }
  void solve(double is_free, double* x, double* null) const {
    VectorXd::Map(null, null_.size()) = null_;
    auto solution = VectorXd::Map(x, null_.size());
    solution = shortest_;
    if (is_free > 0) return;
    solution -= shortest_.tail<1>()(0) / null_.tail<1>()(0) * null_;
    solution.tail<1>()(0) = 0;
  }
  double orientation() const { return sign_; }

 private:
  ClosureSystem& system_;
  VectorXd shortest_, null_;
  int sign_ = 0;
};

template <class Closure>
Seen followed(const TestSheet& sheet, const SheetGeometry<double>& geometry, Closure closure) {
  PathFollower<double, CloseSteps, Closure> follower(sheet.mechanism, std::move(closure));
  Seen seen;
  seen.follower_state = [&] { return follower.state(); };
  const PathPlan plan = sheet.plan();
  follower.follow({&geometry, &plan.start, &plan}, seen);
  return seen;
}

TEST_F(LargeSheet, PathsAreThoseOfDenseMatricesSlow) {
  const ShiftBlock block = sheet_.draws(1, kSeed + 1);
  int limits = 0;
  for (int i = 0; i < block.sheets; ++i) {
    place(sheet_.mechanism, sheet_.vertices(block, i), geometry_);
    ClosureSystem system(sheet_.mechanism);
    const Seen dense = followed(sheet_, geometry_, DenseNullSpace(system));
    const Seen sparse = followed(sheet_, geometry_, PivotedClosure(system));
    EXPECT_EQ(sparse.path.end, dense.path.end);
    EXPECT_NEAR(sparse.path.fold_limit_deg, dense.path.fold_limit_deg, 1e-6);
    ASSERT_EQ(sparse.stations, dense.stations);
    limits += dense.path.end == PathEnd::fold_limit;
    for (std::size_t k = 0; k < dense.states.size(); ++k) {
      for (std::size_t c = 0; c < dense.states[k].creases.size(); ++c) {
        // Both are closed to 1e-12; near flat the Jacobian's least singular value is 1e-4.
        EXPECT_NEAR(half_sine_between(sparse.states[k].creases[c], dense.states[k].creases[c]), 0,
                    1e-8);
      }
    }
  }
  EXPECT_GT(limits, 0) << "a limit point is met";
}

}  // namespace
}  // namespace misalign::solver
