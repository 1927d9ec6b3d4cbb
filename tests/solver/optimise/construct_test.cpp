#include "solver/optimise/construct.hpp"

#include <Eigen/LU>
#include <numeric>
#include <random>

#include "solver/linear/simplex.hpp"
#include "tests/solver/parallel_coordinates.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// The best corner of the feasible set, by trying all: every choice of as many tight bounds as there
// are variables.
double best_corner(const LinearProgram& program) {
  const Eigen::Index n = program.rows.cols(), m = program.rows.rows();
  Eigen::MatrixXd all(m + n, n);
  all << program.rows, -Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd bounds(m + n);
  bounds << program.bounds, Eigen::VectorXd::Zero(n);
  double best = 0;
  std::vector<bool> tight(static_cast<std::size_t>(m + n), false);
  std::fill(tight.begin(), tight.begin() + n, true);
  do {
    Eigen::MatrixXd square(n, n);
    Eigen::VectorXd right(n);
    Eigen::Index row = 0;
    for (Eigen::Index k = 0; k < m + n; ++k) {
      if (!tight[static_cast<std::size_t>(k)]) continue;
      square.row(row) = all.row(k);
      right(row++) = bounds(k);
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(square);
    if (!lu.isInvertible()) continue;
    const Eigen::VectorXd x = lu.solve(right);
    if (((all * x - bounds).array() <= 1e-9).all()) best = std::max(best, program.gain.dot(x));
  } while (std::prev_permutation(tight.begin(), tight.end()));
  return best;
}

TEST(Simplex, FindsTheBestCorner) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    LinearProgram program{RowMatrix(7, 3), Eigen::VectorXd(7), Eigen::VectorXd(3)};
    for (double& entry : program.rows.reshaped()) entry = uniform(random);
    for (double& bound : program.bounds) bound = trial % 3 == 0 ? 0 : std::abs(uniform(random));
    program.rows.bottomRows(3).setIdentity();  // so that nothing is unbounded
    program.bounds.tail(3).setOnes();
    for (double& gain : program.gain) gain = uniform(random);
    const LinearOptimum found = maximize(program);
    ASSERT_EQ(found.end, LinearOptimum::StopReason::optimal);
    EXPECT_NEAR(found.value, best_corner(program), 1e-9) << "trial " << trial;
    EXPECT_NEAR(found.value, program.gain.dot(found.x), 1e-9);
    EXPECT_TRUE(((program.rows * found.x - program.bounds).array() <= 1e-9).all());
  }
}

TEST(Simplex, SaysWhatIsUnbounded) {
  LinearProgram program{RowMatrix::Constant(1, 2, -1), Eigen::VectorXd::Ones(1),
                        Eigen::VectorXd::Ones(2)};
  EXPECT_EQ(maximize(program).end, LinearOptimum::StopReason::unbounded);
}

struct Made {
  Made(int rows, int columns, bool rim, const ConstructOptions& options,
       const char* holes = "checkerboard-odd")
      : sheet(rows, columns, holes),
        family(family_of(sheet.base, rim)),
        studied(construct(sheet.base, family, options)) {}
  static ParallelFamily family_of(const PerforatedSheet& base, bool rim) {
    std::vector<int> vertices = interior_vertices(base.sheet);
    if (rim) {
      vertices.resize(static_cast<std::size_t>(base.sheet.vertex_count()));
      std::iota(vertices.begin(), vertices.end(), 0);
    }
    return std::get<ParallelFamily>(ParallelFamily::of(base, vertices));
  }
  const TestSheet sheet;
  const ParallelFamily family;
  const StudyResult<ConstructStudy> studied;
};

// What the closed form says is what the followed path does: Newton's method on the loops.
TEST(Construct, SheetsDeployOnTheirFollowedPaths) {
  for (const bool rim : {false, true}) {
    for (const char* holes : {"checkerboard-odd", "checkerboard-even"}) {
      const Made made(6, 6, rim, {.amplitude_mm = 4, .stroke = {}, .at_deg = 179, .signs = {}},
                      holes);
      ASSERT_TRUE(made.studied);
      const ConstructStudy& study = *made.studied;
      EXPECT_TRUE(study.is_monotone());
      EXPECT_LE(study.amplitude_mm, 4);
      EXPECT_GE(study.amplitude_mm, 4 - 1e-9);
      EXPECT_FALSE(study.binding.empty());
      EXPECT_GT(study.stroke, 0.005);
      const FoldingHistory history =
          made.sheet.history(made.sheet.base.sheet.vertices_mm + study.shifts_mm);
      EXPECT_GE(history.verdict.deploys_from_sample, 179);
    }
  }
}

// No member with these signs and this amplitude has a better least stroke, to first order: shifts
// are small, so that the order beyond is not seen.
TEST(Construct, NoRandomMemberHasALargerStroke) {
  const ConstructOptions options{.amplitude_mm = 0.01, .stroke = {}, .at_deg = 120, .signs = {}};
  const Made made(6, 6, false, options);
  ASSERT_TRUE(made.studied);
  const Eigen::VectorXd best = coordinates_of(made.family, made.studied->shifts_mm);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    Eigen::VectorXd other = best;
    for (double& value : other) value *= 1 + 0.3 * normal(random);
    Eigen::Matrix2Xd shifts = made.family.shifts_mm(other);
    shifts *= options.amplitude_mm / shifts.cwiseAbs().maxCoeff();
    double least = 1;
    for (const HoleMotion& motion : made.family.motions(shifts)) {
      least = std::min(least, motion.stroke(half_angle_of_deg(options.at_deg)));
    }
    EXPECT_LE(least, made.studied->stroke * (1 + 1e-3));
  }
}

TEST(Construct, GivesTheStrokeThatIsAsked) {
  const Made made(4, 4, true,
                  {.amplitude_mm = 4, .stroke = 0.004, .at_deg = 150, .signs = {1, -1}});
  ASSERT_TRUE(made.studied);
  EXPECT_NEAR(made.studied->stroke, 0.004, 1e-12);
  EXPECT_LT(made.studied->amplitude_mm, 4);
  const auto& holes = made.studied->holes;
  EXPECT_GT(holes[0].direction * holes[0].delta_mm, 0);
  EXPECT_LT(holes[1].delta_mm, 0);
}

TEST(Construct, SaysWhatBinds) {
  const auto fault = [](const ConstructOptions& options, bool rim) {
    const Made made(6, 6, rim, options);
    return made.studied ? OptionFault{} : *made.studied.fault();
  };
  const OptionFault far =
      fault({.amplitude_mm = 0.4, .stroke = 0.5, .at_deg = 179, .signs = {}}, false);
  EXPECT_EQ(far.name, "stroke");
  EXPECT_NE(far.why.find("what binds is A"), std::string::npos) << far.why;
  const std::vector<int> alike(8, 1);
  EXPECT_EQ(fault({.amplitude_mm = 1, .stroke = {}, .at_deg = 179, .signs = alike}, false).name,
            "signs");
  EXPECT_EQ(fault({.amplitude_mm = 1, .stroke = {}, .at_deg = 179, .signs = alike}, true).name, "");
  EXPECT_EQ(fault({.amplitude_mm = 1, .stroke = {}, .at_deg = 179, .signs = {1, 1}}, true).name,
            "signs");
  EXPECT_EQ(fault({.amplitude_mm = 200, .stroke = {}, .at_deg = 179, .signs = {}}, true).name,
            "amplitude_mm");
}

}  // namespace
}  // namespace misalign::solver
