// Tables say of a draw to second order what its path shows, within the bounds they claim:
// elongations and slopes (by central differences) of paths in steps of a tenth of a degree.
#include "solver/model/shift_expansion.hpp"

#include "blocks.hpp"
#include "expansion_sums.hpp"
#include "solver/lanes/expansion_test.hpp"

namespace misalign::solver {
namespace {

constexpr double kAmplitude_mm = 0.4;

// Takes down what is expected of each sheet.
struct Expectations {
  Expectations(int sheets, int diagonals)
      : both(static_cast<std::size_t>(sheets)),
        signs(both.size(), std::vector<signed char>(static_cast<std::size_t>(diagonals))) {}
  void expect(int sheet, const signed char* directions, bool reverses, int at) {
    sample = at;
    both[sheet] = reverses;
    std::copy_n(directions, signs[sheet].size(), signs[sheet].begin());
  }
  std::vector<char> both;
  std::vector<std::vector<signed char>> signs;
  int sample = 0;
};

struct ExpandedSheet {
  int rows, columns;
  Shifted shifted;
  int threshold, early, late;  // samples of a degree
};
void PrintTo(const ExpandedSheet& c, std::ostream* out) {
  *out << c.rows << "x" << c.columns << " to " << c.threshold;
}

class ShiftExpansions : public testing::TestWithParam<ExpandedSheet> {
 protected:
  ShiftExpansions()
      : sheets_(GetParam().rows, GetParam().columns, GetParam().shifted),
        model_(sheets_.with_threshold(GetParam().threshold, {}, kAmplitude_mm)),
        test_(model_),
        block_(sheets_.draws(kAsked, kSeed)) {}

  // Of one sheet: values of its path against estimates, and whether it is as it was expected to be.
  void compare(int sheet, const FoldingHistory& history, const std::vector<signed char>& signs) {
    const Eigen::MatrixXd path = history.length_mm / sheets_.mechanism.panel_width_mm;
    const int early = 10 * GetParam().early - 1, late = 10 * GetParam().late - 1;
    if (path.rows() <= late + 1) return;
    const auto sums = sums_of(test_.expansion(), block_.of(sheet));
    const auto near = [&](ShiftedQuantity quantity, int d, double truth, double error) {
      const auto estimate = test_.expansion().estimate(quantity, d, sums.data());
      EXPECT_NEAR(estimate.value, truth, estimate.bound + error) << "diagonal " << d;
      largest_share_ =
          std::max(largest_share_, (std::abs(estimate.value - truth) - error) / estimate.bound);
    };
    for (int d = 0; d < sheets_.mechanism.diagonal_count(); ++d) {
      const double flat = history.flat_mm[d] / sheets_.mechanism.panel_width_mm;
      const double elongation = path(early, d) - flat;
      const double slope = (path(late + 1, d) - path(late - 1, d)) / (0.2 * kRadPerDeg);
      near(ShiftedQuantity::elongation, d, elongation, 0);
      near(ShiftedQuantity::slope, d, slope, kDifferenceError);
      const double sign = signs[static_cast<std::size_t>(d)];
      EXPECT_TRUE(sign == 0 || elongation * sign > 0 || slope * sign > 0) << "diagonal " << d;
    }
  }

  // Asking is cheap; the paths of the first of them are followed.
  static constexpr int kAsked = 400, kFollowed = 40 / kFewer;
  // Of central differences over a tenth of a degree: h^2 / 6 of third derivatives up to 10.
  static constexpr double kDifferenceError = 5e-6;
  const DrawableSheet sheets_;
  const Model model_;
  ExpansionTest<double, float> test_;
  const ShiftBlock block_;
  double largest_share_ = 0;
};

TEST_P(ShiftExpansions, SayWhatThePathShows) {
  ASSERT_TRUE(test_.is_there());
  Expectations seen(kAsked, sheets_.mechanism.diagonal_count());
  test_.run(block_, seen);
  ASSERT_EQ(seen.sample, GetParam().late);
  PathPlanOptions fine;
  fine.sample_deg = 0.1;
  fine.end_deg = GetParam().late + 0.1;
  for (int sheet = 0; sheet < kFollowed; ++sheet) {
    SCOPED_TRACE("sheet " + std::to_string(sheet));
    const FoldingHistory history = sheets_.history(sheets_.vertices(block_, sheet), fine);
    compare(sheet, history, seen.signs[sheet]);
    if (seen.both[sheet]) {
      EXPECT_LT(history.verdict.deploys_from_sample, 10 * GetParam().late + 1);
    }
  }
  EXPECT_GE(std::count(seen.both.begin(), seen.both.end(), true), 0.3 * kAsked)
      << "or they are of no use";
  RecordProperty("largest_share_of_a_bound", scientific(largest_share_));
}

// The late angle is 0.8 of the far test's, the early one 0.1.
INSTANTIATE_TEST_SUITE_P(Drawn, ShiftExpansions,
                         testing::Values(ExpandedSheet{6, 6, Shifted::interior, 170, 15, 120},
                                         ExpandedSheet{6, 6, Shifted::ring, 170, 15, 120},
                                         ExpandedSheet{4, 4, Shifted::interior, 150, 14, 118},
                                         ExpandedSheet{8, 6, Shifted::interior, 150, 14, 118}));

TEST(ShiftExpansion, SpeaksOfTernaryShiftsOnly) {
  const DrawableSheet sheets(4, 4);
  const Model any = sheets.with_threshold(150),
              ternary = sheets.with_threshold(150, {}, kAmplitude_mm);
  EXPECT_FALSE((ExpansionTest<double, float>(any).is_there()));
  ExpansionTest<double, float> test(ternary);
  ASSERT_TRUE(test.is_there());
  struct Count {
    void expect(int, const signed char*, bool, int) { ++sheets; }
    int sheets = 0;
  } spoken_of;
  test.run(sheets.draws(5, kSeed, 0.3), spoken_of);
  EXPECT_EQ(spoken_of.sheets, 0);
  test.run(sheets.draws(5, kSeed, kAmplitude_mm), spoken_of);
  EXPECT_EQ(spoken_of.sheets, 5);
}

}  // namespace
}  // namespace misalign::solver
