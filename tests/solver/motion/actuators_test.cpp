// Springs on the diagonals against lengths between vertex coordinates, fine differences and sets
// that are tried one by one.
#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <random>

#include "solver/motion/actuation.hpp"
#include "solver/records/metrics.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::solver {
namespace {

const Actuators kSprings{Springs{20}, {}};

struct Table1 : testing::Test {
  Table1()
      : sheet(6, 6), vertices_mm(sheet.shifted(golden("table1_odd.json")["displacements_mm"])) {}

  OwnSheet path(double look_deg = 0, double end_deg = 180, double sample_deg = 1) const {
    PathPlanOptions options;
    options.sample_deg = sample_deg;
    options.look_deg = look_deg;
    options.end_deg = end_deg;
    return OwnSheet(sheet.base, vertices_mm - sheet.base.sheet.vertices_mm, options);
  }

  TestSheet sheet;
  FlatVertices vertices_mm;
};

TEST_F(Table1, EnergyIsThatOfLengthsBetweenVertices) {
  const OwnSheet own = path();
  const Sheet& folded = own.sheet;
  const Actuation actuation = actuate(folded, kSprings);
  ASSERT_EQ(actuation.energy_n_mm.size(), folded.shapes_mm().size() + 1);
  EXPECT_EQ(actuation.energy_n_mm[0], 0);
  for (std::size_t row = 0; row < folded.shapes_mm().size(); ++row) {
    const Eigen::Matrix3Xd& shape = folded.shapes_mm()[row];
    double energy = 0;
    for (const Diagonal& diagonal : sheet.mechanism.diagonals) {
      const double flat_mm = (vertices_mm.col(diagonal.from) - vertices_mm.col(diagonal.to)).norm();
      const double length_mm = (shape.col(diagonal.from) - shape.col(diagonal.to)).norm();
      energy += 10 * (length_mm - flat_mm) * (length_mm - flat_mm);
    }
    // Lengths agree to 1e-9 mm, and at most 16 of them are stretched by less than 10 mm.
    EXPECT_NEAR(actuation.energy_n_mm[row + 1], energy, 20 * 10 * 16 * 1e-9) << row;
  }
}

TEST_F(Table1, MomentIsTheRateOfTheEnergy) {
  // Looked at every tenth of a degree: central differences are off by h^2 E''' / 6.
  const OwnSheet own = path(0.1, 150);
  const Sheet& fine = own.sheet;
  const Actuation actuation = actuate(fine, kSprings);
  double largest = 0;
  for (const double moment : actuation.moment_n_mm) largest = std::max(largest, std::abs(moment));
  const double h_rad = 0.1 * kRadPerDeg;
  for (std::size_t row = 1; row + 1 < actuation.pilot_deg.size(); ++row) {
    const double rate =
        (actuation.energy_n_mm[row + 1] - actuation.energy_n_mm[row - 1]) / (2 * h_rad);
    EXPECT_NEAR(actuation.moment_n_mm[row], rate, 1e-4 * largest) << actuation.pilot_deg[row];
  }
  EXPECT_GT(largest, 1);
}

// Virtual work on any other pair of points: what the springs let go over a step, all of the same
// force, is what the span takes up. `length` gives the distance of two vertices a little before and
// after.
template <class Length>
double work_over_work(const Mechanism& mechanism, const FlatVertices& vertices_mm,
                      const Length& before, const Length& after) {
  int corner = 0, opposite = 0;  // farthest apart when flat; the first pair counts
  for (int a = 0; a < vertices_mm.cols(); ++a) {
    for (int b = a + 1; b < vertices_mm.cols(); ++b) {
      if ((vertices_mm.col(a) - vertices_mm.col(b)).norm() >
          (vertices_mm.col(corner) - vertices_mm.col(opposite)).norm()) {
        corner = a, opposite = b;
      }
    }
  }
  double work = 0;
  for (const Diagonal& diagonal : mechanism.diagonals) {
    work += std::abs(after(diagonal.from, diagonal.to) - before(diagonal.from, diagonal.to));
  }
  return work / std::abs(after(corner, opposite) - before(corner, opposite));
}

// In steps of a degree and of five against differences over a hundredth of one, and where the pilot
// hardly moves any more: a degree and a half before the fold limit.
TEST_F(Table1, AdvantageIsWorkOverWork) {
  const OwnSheet own = path(0.01, 156);
  const Sheet& fine = own.sheet;
  const auto shape_of = [&](int row) {
    return [&fine, row](int from, int to) {
      return (fine.shapes_mm()[row].col(from) - fine.shapes_mm()[row].col(to)).norm();
    };
  };
  for (const int step_deg : {1, 5}) {
    const OwnSheet coarse = path(0, step_deg == 1 ? 156 : 155, step_deg);
    const Actuation actuation = actuate(coarse.sheet, kSprings);
    EXPECT_TRUE(std::isnan(actuation.mechanical_advantage[0]));
    for (const int deg : {5, 10, 80, 140, 155}) {
      const int row = 100 * deg - 1;
      ASSERT_NEAR(fine.history().stations[row].pilot_deg, deg, 1e-9);
      const double advantage = work_over_work<std::function<double(int, int)>>(
          sheet.mechanism, vertices_mm, shape_of(row - 1), shape_of(row + 1));
      // The differences' own error: the square of 0.01 over how far the limit is, 1.35 degrees; and
      // close to flat over how far that is.
      EXPECT_NEAR(actuation.mechanical_advantage[deg / step_deg] / advantage, 1, 1e-4)
          << deg << " in steps of " << step_deg;
    }
  }
}

// At D where the next sample lies beyond a fold limit that is less than a tenth of a degree away,
// by vertex coordinates.
TEST(Advantage, IsThatOfVertexCoordinatesNextToFoldLimits) {
  const DrawableSheet sheets(4, 4);
  const ShiftBlock block = sheets.draws(300, kSeed);
  const Model model(sheets.base);
  SheetSolver solver(model);
  int found = 0;
  double worst = 0;
  for (int i = 0; i < block.sheets && found < 5; ++i) {
    const FlatVertices vertices_mm = sheets.vertices(block, i);
    const Sheet folded(solver, vertices_mm - sheets.base.sheet.vertices_mm);
    const PathResult& end = folded.history().path;
    const double d_deg = folded.history().verdict.deploys_from_sample;
    const double gap_deg = end.fold_limit_deg - d_deg;
    if (end.end != PathEnd::fold_limit || d_deg < 90 || gap_deg > 0.1 || gap_deg < 0.01) continue;
    ++found;
    VertexCoordinates other(sheets.base, vertices_mm, folded.shapes_mm()[9], 10);
    std::array<Eigen::Matrix3Xd, 2> shapes;
    for (const int k : {0, 1}) {
      ASSERT_TRUE(other.fold_to(d_deg + (2 * k - 1) * gap_deg / 50));
      shapes[static_cast<std::size_t>(k)] = other.points_mm();
    }
    const auto lengths_of = [](const Eigen::Matrix3Xd& shape) {
      return [&shape](int from, int to) { return (shape.col(from) - shape.col(to)).norm(); };
    };
    const double advantage = work_over_work<std::function<double(int, int)>>(
        sheets.mechanism, vertices_mm, lengths_of(shapes[0]), lengths_of(shapes[1]));
    const auto row = static_cast<std::size_t>(folded.rows_up_to_d());
    const double off = actuate(folded, kSprings).mechanical_advantage[row] / advantage - 1;
    worst = std::max(worst, std::abs(off));
    EXPECT_LT(std::abs(off), 1e-3) << "draw " << i << ", limit " << end.fold_limit_deg;
  }
  EXPECT_GT(found, 1);
  RecordProperty("worst", std::to_string(worst));
}

TEST_F(Table1, WeakestPointAndFewDiagonals) {
  const OwnSheet own = path();
  const Sheet& folded = own.sheet;
  const Actuation actuation = actuate(folded, kSprings);
  ASSERT_TRUE(actuation.weakest && actuation.few);
  const int d = folded.history().verdict.deploys_from_sample;
  for (int row = 5; row <= d; ++row) {
    EXPECT_GE(actuation.moment_n_mm[row], actuation.weakest->moment_n_mm) << row;
  }
  EXPECT_GE(actuation.weakest->pilot_deg, 5);
  EXPECT_LE(actuation.weakest->pilot_deg, d);
  double least = std::numeric_limits<double>::infinity();
  for (int row = 5; row <= d; ++row) {
    double sum = 0;
    for (const int k : actuation.few->diagonals) sum += actuation.moment_by_n_mm(row, k);
    least = std::min(least, sum);
  }
  EXPECT_NEAR(least / actuation.weakest->moment_n_mm, actuation.few->share, 1e-9);
  EXPECT_GE(actuation.few->share, kShareOfFew);
}

// The moment passes zero at a stop, from which it pulls back on either side.
TEST_F(Table1, TheMomentCountsBeyondAStop) {
  const OwnSheet own = path();
  const Actuation stopped =
      actuate(own.sheet, {.fill = Springs{.rest_deg = 60}, .stroke_limit = {}});
  EXPECT_LT(stopped.moment_n_mm[59], 0);
  EXPECT_NEAR(stopped.moment_n_mm[60], 0, 1e-6);
  ASSERT_TRUE(stopped.weakest && stopped.few);
  EXPECT_GT(stopped.weakest->moment_n_mm, 0);
  for (int row = 61; row <= own.sheet.history().verdict.deploys_from_sample; ++row) {
    EXPECT_GE(stopped.moment_n_mm[row], stopped.weakest->moment_n_mm) << row;
  }
}

// Stretched plates drive it through the angle where they would rest otherwise.
TEST_F(Table1, TheMomentOfStretchedPlatesCountsFromNearFlat) {
  const OwnSheet own = path();
  const Actuation stretched = actuate(
      own.sheet, {.fill = RubberPlates{.prestretch = 1.2, .rest_deg = 60}, .stroke_limit = {}});
  ASSERT_TRUE(stretched.weakest);
  EXPECT_EQ(stretched.counts_from_deg, 5);
  EXPECT_LT(stretched.weakest->pilot_deg, 60);
}

TEST_F(Table1, StrokeLimitIsReachedWhereLengthsSay) {
  const OwnSheet own = path();
  const Sheet& folded = own.sheet;
  // Table 1: elongations of -5.19 % to +2.75 % at 156 degrees (model.md).
  EXPECT_FALSE(actuate(folded, {Springs{50}, 0.052}).over_stroke);
  const auto over = actuate(folded, {Springs{50}, 0.05}).over_stroke;
  ASSERT_TRUE(over);
  const auto reaches = [&](double pilot_deg) {
    const auto row = static_cast<Eigen::Index>(pilot_deg) - 1;
    double most = 0;
    for (Eigen::Index k = 0; k < folded.history().length_mm.cols(); ++k) {
      const double flat_mm = folded.history().flat_mm[static_cast<std::size_t>(k)];
      most = std::max(most, std::abs(folded.history().length_mm(row, k) / flat_mm - 1));
    }
    return most;
  };
  EXPECT_GT(reaches(over->from_deg), 0.05);
  EXPECT_LE(reaches(over->from_deg - 1), 0.05);
}

// Shapes are those of another solver, wherever they are laid.
TEST_F(Table1, ShapesAreThoseOfVertexCoordinates) {
  const OwnSheet own = path();
  const Sheet& folded = own.sheet;
  VertexCoordinates other(sheet.base, vertices_mm, folded.shapes_mm()[9], 10);
  const Eigen::Matrix3Xd mine = folded.shapes_mm()[99];
  ASSERT_EQ(mine.cols(), vertices_mm.cols());
  ASSERT_TRUE(other.fold_to(100));
  for (int a = 0; a < mine.cols(); ++a) {
    for (int b = 0; b < a; ++b) {
      EXPECT_NEAR((mine.col(a) - mine.col(b)).norm(), other.distance_mm(a, b), 1e-8);
    }
  }
}

// Laid over the flat sheet no shape jumps, and no turn or move brings it nearer.
TEST_F(Table1, ShapesLieOverTheFlatSheet) {
  const OwnSheet own = path();
  const Sheet& folded = own.sheet;
  Eigen::Matrix3Xd before = Eigen::Matrix3Xd::Zero(3, vertices_mm.cols());
  before.topRows<2>() = vertices_mm;
  const Eigen::Matrix3Xd flat = before;
  for (const Eigen::Matrix3Xd& shape : folded.shapes_mm()) {
    EXPECT_LT((shape - before).colwise().norm().maxCoeff(), 20);  // of a sheet 520 mm wide
    before = shape;
    const double distance_sq = (shape - flat).squaredNorm();
    for (int axis = 0; axis < 3; ++axis) {
      for (const double by : {-0.01, 0.01}) {
        const Eigen::Vector3d along = by * Eigen::Vector3d::Unit(axis);
        EXPECT_LT(distance_sq, ((shape.colwise() + along) - flat).squaredNorm());
        const Eigen::Vector3d middle = shape.rowwise().mean();
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(by, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
        const Eigen::Matrix3Xd turned =
            (turn * (shape.colwise() - middle)).eval().colwise() + middle;
        EXPECT_LT(distance_sq, (turned - flat).squaredNorm());
      }
    }
  }
}

// Every set, one by one, from its own sums.
FewDiagonals one_by_one(const Eigen::MatrixXd& moments, double share,
                        const std::vector<std::pair<int, int>>& never_both = {}) {
  const double all = moments.rowwise().sum().minCoeff();
  FewDiagonals best{{}, 0, true};
  for (std::uint32_t set = 1; set < (1u << moments.cols()); ++set) {
    std::vector<int> columns;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(moments.rows());
    for (int k = 0; k < moments.cols(); ++k) {
      if (set >> k & 1) columns.push_back(k), sum += moments.col(k);
    }
    const double reached = sum.minCoeff() / all;
    const bool is_allowed = std::ranges::none_of(never_both, [&](const auto& pair) {
      return (set >> pair.first & 1) && (set >> pair.second & 1);
    });
    if (reached < share || !is_allowed) continue;
    const bool better = best.diagonals.empty() || columns.size() < best.diagonals.size() ||
                        (columns.size() == best.diagonals.size() && reached > best.share);
    if (better) best = {columns, reached, true};
  }
  return best;
}

TEST(FewDiagonals, AreTheBestOfEverySet) {
  std::mt19937 words(2016);
  std::uniform_real_distribution<double> moment(0.01, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const int columns = 1 + trial % 11;
    const Eigen::MatrixXd moments =
        Eigen::MatrixXd::NullaryExpr(1 + trial % 7, columns, [&] { return moment(words); });
    for (const double share : {0.1, 0.5, 0.9}) {
      const FewDiagonals few = *few_diagonals(moments, share), best = one_by_one(moments, share);
      EXPECT_EQ(few.diagonals, best.diagonals) << trial;
      EXPECT_NEAR(few.share, best.share, 1e-12);
      EXPECT_TRUE(few.proven);
    }
  }
}

TEST(FewDiagonals, NeverHaveTwoThatTouch) {
  std::mt19937 words(57);
  std::uniform_real_distribution<double> moment(0.01, 1);
  int none = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int columns = trial % 3 == 0 ? 18 : 8;
    const Eigen::MatrixXd moments =
        Eigen::MatrixXd::NullaryExpr(4, columns, [&] { return moment(words); });
    std::vector<std::pair<int, int>> never_both{{0, 3}};
    for (int d = 0; d < columns; d += 2) never_both.emplace_back(d, d + 1);
    const double share = trial % 2 == 0 ? 0.4 : 0.6;
    const std::optional<FewDiagonals> few = few_diagonals(moments, share, never_both);
    if (columns == 8) {
      const FewDiagonals best = one_by_one(moments, share, never_both);
      EXPECT_EQ(few.has_value(), !best.diagonals.empty());
      if (few) {
        EXPECT_EQ(few->diagonals, best.diagonals);
      }
    }
    none += few ? 0 : 1;
    for (const auto& [a, b] : never_both) {
      if (!few) continue;
      EXPECT_FALSE(std::ranges::binary_search(few->diagonals, a) &&
                   std::ranges::binary_search(few->diagonals, b));
    }
  }
  EXPECT_GT(none, 0);
  EXPECT_LT(none, 60);
}

// Beyond 16 not every set is tried: what is said of a set must hold, and what is proven too.
TEST(FewDiagonals, OfManyAreWhatTheyAreSaidToBeSlow) {
  std::mt19937 words(17);
  std::uniform_real_distribution<double> moment(0.01, 1);
  int proven = 0, smallest = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Eigen::MatrixXd moments =
        Eigen::MatrixXd::NullaryExpr(2, 17, [&] { return std::pow(moment(words), 3); });
    const FewDiagonals few = *few_diagonals(moments, 0.5), best = one_by_one(moments, 0.5);
    const double all = moments.rowwise().sum().minCoeff();
    EXPECT_NEAR(moments(Eigen::all, few.diagonals).rowwise().sum().minCoeff() / all, few.share,
                1e-12);
    EXPECT_GE(few.share, 0.5 - 1e-12);
    if (few.proven) {
      EXPECT_EQ(few.diagonals.size(), best.diagonals.size());
    }
    // Proven by the worst row alone, as the header says, and only so.
    std::size_t of_worst_row = 0;
    for (Eigen::Index row = 0; row < moments.rows(); ++row) {
      const FewDiagonals alone = one_by_one(moments.row(row), 0.5 * all / moments.row(row).sum());
      of_worst_row = std::max(of_worst_row, alone.diagonals.size());
    }
    EXPECT_EQ(few.proven, few.diagonals.size() == of_worst_row) << trial;
    proven += few.proven;
    smallest += few.diagonals.size() == best.diagonals.size();
  }
  EXPECT_GT(proven, 0);
  EXPECT_GT(smallest, 6);
  RecordProperty("proven", proven);
  RecordProperty("smallest", smallest);
}

TEST(FewDiagonals, NoneCanBeMissedWhereEachIsNeeded) {
  const Eigen::MatrixXd moments = Eigen::MatrixXd::Identity(18, 18);
  const FewDiagonals few = *few_diagonals(moments, 0.5);
  EXPECT_EQ(few.diagonals.size(), 18u);
  EXPECT_EQ(few.share, 1);
}

}  // namespace
}  // namespace misalign::solver
