// Paths as functions against paths whose every degree is solved, by another step control and
// without polynomials: lengths within their bounds, the same verdicts, limit points and reversals.
#include "solver/continuation/path_function.hpp"

#include <cmath>

#include "solver/lanes/lane_batch.hpp"
#include "solver/records/record_sheet.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/record_path.hpp"

namespace misalign::solver {
namespace {

constexpr int kDrawnOfEach = 60;

class PathFunctions : public testing::TestWithParam<DrawnSheets> {
 protected:
  const DrawableSheet sheets_{GetParam().rows, GetParam().columns, GetParam().shifted};
  const ShiftBlock block_ = sheets_.draws(GetParam().draws / kFewer, kSeed + 7);
};

INSTANTIATE_TEST_SUITE_P(Draws, PathFunctions,
                         testing::Values(DrawnSheets{4, 4, Shifted::interior, kDrawnOfEach},
                                         DrawnSheets{6, 6, Shifted::interior, kDrawnOfEach},
                                         DrawnSheets{6, 6, Shifted::ring, kDrawnOfEach},
                                         DrawnSheets{8, 6, Shifted::interior, kDrawnOfEach / 2}));

// Compares a function with the history of the same sheet, segment by segment.
class Comparison {
 public:
  Comparison(const Model& model, const FlatVertices& vertices_mm)
      : model_(model), history_(record_history(model, vertices_mm)), estimate_(model.mechanism()) {
    place(model.mechanism(), vertices_mm, geometry_);
  }

  PathStart start() const { return {&geometry_, &model_.path().start, &model_.path()}; }
  ObserverResult see(const PathFunction& function, int) {
    const double end_rad = function.pilot(function.end());
    for (; row_ < history_.length_mm.rows(); ++row_) {
      const Station& station = history_.stations[static_cast<std::size_t>(row_)];
      // Next to a limit point rates grow without bound.
      if (station.pilot_deg * kRadPerDeg > end_rad - (function.turns() ? 1e-4 : -1e-12)) break;
      const double x = function.locate(station.pilot_deg * kRadPerDeg);
      EXPECT_NEAR(function.pilot(x), station.pilot_deg * kRadPerDeg, 1e-13);
      function.look(x, estimate_);
      for (std::size_t d = 0; d < estimate_.lengths.size(); ++d) {
        const auto column = static_cast<Eigen::Index>(d);
        const double width_mm = model_.mechanism().panel_width_mm;
        const double off = estimate_.lengths[d] - history_.length_mm(row_, column) / width_mm;
        EXPECT_LE(std::abs(off), estimate_.length_errors[d]) << station.pilot_deg << " deg";
        largest_bound_ = std::max(largest_bound_, estimate_.length_errors[d]);
        const double slope_off =
            estimate_.slopes[d] - history_.slope_mm_per_deg(row_, column) / width_mm / kRadPerDeg;
        slope_off_ = std::max(slope_off_, std::abs(slope_off));
      }
      ++compared_;
    }
    return ObserverResult::go_on;
  }
  void ended(const PathResult& path, int) { path_ = path; }

  const FoldingHistory& history() const { return history_; }
  const PathResult& path() const { return path_; }
  int compared() const { return compared_; }
  double largest_bound() const { return largest_bound_; }
  double slope_off() const { return slope_off_; }

 private:
  const Model& model_;
  const FoldingHistory history_;
  PathFunction::Estimate estimate_;
  SheetGeometry<double> geometry_;
  Eigen::Index row_ = 0;
  PathResult path_{};
  int compared_ = 0;
  double largest_bound_ = 0, slope_off_ = 0;
};

TEST_P(PathFunctions, AreWithinTheirBoundsOfWhatIsSolved) {
  PathPlanOptions to_175;
  to_175.end_deg = 175;
  const Model model(sheets_.base, to_175);
  PathFollower<double, LongSteps> follower(model.mechanism(), model.elimination());
  int ended = 0, compared = 0;
  for (int i = 0; i < block_.sheets; ++i) {
    SCOPED_TRACE(i);
    Comparison comparison(model, sheets_.vertices(block_, i));
    follower.follow(comparison.start(), comparison);
    compared += comparison.compared();
    // Bounds are worth something: a tenth of a millionth of a panel's width away from limits.
    if (comparison.path().lost()) continue;
    ++ended;
    EXPECT_EQ(comparison.path().end, comparison.history().path.end);
    EXPECT_NEAR(comparison.path().fold_limit_deg, comparison.history().path.fold_limit_deg, 1e-6);
    EXPECT_LT(comparison.largest_bound(), 1e-3);
    EXPECT_LT(comparison.path().newton_iterations,
              0.5 * comparison.history().path.newton_iterations);
  }
  EXPECT_GE(ended, 0.9 * block_.sheets - 1);
  EXPECT_GT(compared, 100 * block_.sheets);
}

TEST_P(PathFunctions, JudgeAsCloseStepsDo) {
  const Model model = sheets_.with_threshold(0);
  LaneBatch<double, float> batch(model);
  const std::vector<Verdict>& verdicts = batch.judge(block_);
  for (int i = 0; i < block_.sheets; ++i) {
    const Verdict close = record_history(model, sheets_.vertices(block_, i)).verdict;
    EXPECT_EQ(verdicts[i].deploys_from_sample, close.deploys_from_sample) << i;
    EXPECT_EQ(verdicts[i].first_fault, close.first_fault) << i;
    EXPECT_EQ(verdicts[i].where, close.where) << i;
  }
  // By functions: close steps take some 350 iterations to 180 degrees.
  const double iterations = static_cast<double>(batch.path_effort().iterations);
  EXPECT_LT(iterations / block_.sheets, 100);
}

// Of the states that a record wants exactly: against the history's, which solves every sample.
TEST_P(PathFunctions, RecordsAreThoseOfTheHistory) {
  const Model model = sheets_.with_threshold(60);
  int complete = 0;
  for (int i = 0; i < block_.sheets; ++i) {
    SCOPED_TRACE(i);
    const FlatVertices vertices_mm = sheets_.vertices(block_, i);
    const PathRecord record = record_path(model, vertices_mm);
    const PathRecord close = record_of(record_history(model, vertices_mm), model.mechanism());
    ASSERT_EQ(record.verdict.deploys_from_sample, close.verdict.deploys_from_sample);
    EXPECT_EQ(record.verdict.first_fault, close.verdict.first_fault);
    if (close.verdict.deploys_from_sample < 60) continue;
    ++complete;
    EXPECT_NEAR(record.path.fold_limit_deg, close.path.fold_limit_deg, 1e-6);
    ASSERT_EQ(record.lengths.size(), close.lengths.size());
    const std::size_t at_d = close.lengths.size() - close.flat.size();
    for (std::size_t k = 0; k < close.lengths.size(); ++k) {
      // Solved at D, and elsewhere as well as segments are believed.
      EXPECT_NEAR(record.lengths[k], close.lengths[k], k < at_d ? 5e-6 : 1e-10) << k;
    }
    EXPECT_NEAR(record.singular_value_min / close.singular_value_min, 1, 1e-5);
    EXPECT_LE(record.residual_max, Newton::Options{}.closure_tolerance);
    EXPECT_LE(record.isometry_error, 1e-10);
    ASSERT_EQ(record.miscut_margin_mm.has_value(), close.miscut_margin_mm.has_value());
    if (close.miscut_margin_mm) {
      EXPECT_NEAR(*record.miscut_margin_mm, *close.miscut_margin_mm, 1e-8);
    }
  }
  EXPECT_GT(complete, block_.sheets / 3);
}

// The first reversal against the root of a rate of change, between solves. (Of the few sheets that
// are left for close steps it is a cubic's.)
TEST_P(PathFunctions, ReverseWhereARateOfChangeIsZero) {
  const Model model = sheets_.with_threshold(60);
  PathFollower<double, LongSteps> follower(model.mechanism(), model.elimination());
  PathFollower<double> close_follower(model.mechanism(), model.elimination());
  Recorder<double> recorder(model, close_follower);
  FunctionRecorder<double> functions(model, follower, close_follower, recorder);
  int reversed = 0;
  for (int i = 0; i < (block_.sheets + 2) / 3 + 1; ++i) {
    SCOPED_TRACE(i);
    const FlatVertices vertices_mm = sheets_.vertices(block_, i);
    const auto closely = recorder.effort().iterations;
    const PathRecord record = functions.record(SheetBlock(vertices_mm)).front();
    if (recorder.effort().iterations > closely) continue;
    if (record.lengths.empty() || !record.extremes.reverses_deg) continue;
    const double at_deg = *record.extremes.reverses_deg;
    if (at_deg > record.path.fold_limit_deg - 2) continue;
    ++reversed;
    const auto slopes_at = [&](double pilot_deg) {
      PathPlanOptions options;
      options.end_deg = pilot_deg;
      const auto history = record_history(Model(sheets_.base, options), vertices_mm);
      return Eigen::RowVectorXd(history.slope_mm_per_deg.bottomRows(1));
    };
    // Which one changes its sign, and how fast; solved slopes are good to 5e-10 mm per degree.
    constexpr double kWide_deg = 1e-3, kSlopeError = 5e-10;
    const Eigen::RowVectorXd wide = slopes_at(at_deg + kWide_deg) - slopes_at(at_deg - kWide_deg);
    const Eigen::RowVectorXd here = slopes_at(at_deg);
    Eigen::Index reversing;
    here.cwiseAbs().minCoeff(&reversing);
    const double curvature = std::abs(wide(reversing)) / (2 * kWide_deg);
    const double room_deg = 1e-6 + kSlopeError / curvature;
    ASSERT_LT(room_deg, 1e-4);
    EXPECT_LT(slopes_at(at_deg - room_deg)(reversing) * slopes_at(at_deg + room_deg)(reversing), 0)
        << at_deg << ", within " << room_deg;
  }
  EXPECT_GT(reversed, 0);
}

}  // namespace
}  // namespace misalign::solver
