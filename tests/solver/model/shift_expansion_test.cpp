// Tables say of a draw to second order what its path shows, within the bounds they claim:
// elongations and slopes (by differences) where paths in steps of a tenth of a degree get to the
// same level.
#include "solver/model/shift_expansion.hpp"

#include "solver/lanes/expansion_test.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/expansion_sums.hpp"

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
  int threshold;
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

  // The sheet's own level at each station of a path: the sum of its |fold angles|, deg.
  Eigen::VectorXd levels(const FoldingHistory& history) const {
    Eigen::VectorXd levels = Eigen::VectorXd::Zero(history.fold_angle_deg.rows());
    for (std::size_t k = 0; k < sheets_.mechanism.creases.size(); ++k) {
      levels += sheets_.mechanism.creases[k].assignment *
                history.fold_angle_deg.col(static_cast<Eigen::Index>(k));
    }
    return levels;
  }
  // Of the base folding with this pilot angle.
  double base_level(double pilot_deg) const {
    const FoldState<double> base = sheets_.folded(pilot_deg);
    double level = 0;
    for (std::size_t k = 0; k < base.creases.size(); ++k)
      level += std::abs(angle_deg(base.creases[k]));
    return level;
  }

  // Of one sheet: values of its path against estimates, and whether it is as it was expected to be.
  // Returns the last station at which it may be in order where it is expected to reverse: one
  // degree beyond the late level, or all if its path does not get there.
  Eigen::Index compare(int sheet, const FoldingHistory& history,
                       const std::vector<signed char>& signs) {
    const Eigen::MatrixXd path = history.length_mm / sheets_.mechanism.panel_width_mm;
    const Eigen::VectorXd level = levels(history);
    // The station before the path gets to this level, and what is left to it of a step.
    const auto find = [&](double wanted) {
      const Eigen::Index k =
          std::lower_bound(level.begin(), level.end(), wanted) - level.begin() - 1;
      return std::pair(k, (wanted - level[k]) / (level[k + 1] - level[k]));
    };
    const double early_deg = test_.early_deg(), late_deg = test_.late_deg();
    if (level[level.size() - 1] < base_level(late_deg)) return level.size();
    const auto [early, early_part] = find(base_level(early_deg));
    const auto [late, late_part] = find(base_level(late_deg));
    const double per_pilot = (base_level(late_deg + 0.05) - base_level(late_deg - 0.05)) / 0.1;
    const auto near = [&](ShiftedQuantity quantity, int d, double truth) {
      const auto sums =
          sums_of(test_.expansion(), d / ShiftExpansion::kDiagonals, block_.of(sheet));
      const auto estimate = test_.expansion().estimate(quantity, d, sums.data());
      EXPECT_NEAR(estimate.value, truth, estimate.bound + kDifferenceError) << "diagonal " << d;
      largest_share_ = std::max(
          largest_share_, (std::abs(estimate.value - truth) - kDifferenceError) / estimate.bound);
    };
    for (int d = 0; d < sheets_.mechanism.diagonal_count(); ++d) {
      const double flat = history.flat_mm[d] / sheets_.mechanism.panel_width_mm;
      const double elongation =
          path(early, d) + early_part * (path(early + 1, d) - path(early, d)) - flat;
      const auto slope_after = [&](Eigen::Index k) {
        return (path(k + 1, d) - path(k - 1, d)) / (level[k + 1] - level[k - 1]) / kRadPerDeg;
      };
      const double slope =
          per_pilot * ((1 - late_part) * slope_after(late) + late_part * slope_after(late + 1));
      near(ShiftedQuantity::elongation, d, elongation);
      near(ShiftedQuantity::slope, d, slope);
      const double sign = signs[static_cast<std::size_t>(d)];
      EXPECT_TRUE(sign == 0 || elongation * sign > 0 || slope * sign > 0) << "diagonal " << d;
    }
    return late + 1 + 10;
  }

  // Asking is cheap; the paths of the first of them are followed.
  static constexpr int kAsked = 400, kFollowed = 40 / kFewer;
  // Of differences and straight lines over a tenth of a degree: h^2 / 4 of third derivatives up to
  // 6.
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
  ASSERT_EQ(seen.sample, static_cast<int>(test_.late_deg()));
  PathPlanOptions fine;
  fine.sample_deg = 0.1;
  for (int sheet = 0; sheet < kFollowed; ++sheet) {
    SCOPED_TRACE("sheet " + std::to_string(sheet));
    const FoldingHistory history = sheets_.history(sheets_.vertices(block_, sheet), fine);
    const Eigen::Index last = compare(sheet, history, seen.signs[sheet]);
    if (seen.both[sheet]) {
      EXPECT_LE(history.verdict.deploys_from_sample, last);
      EXPECT_LT(history.verdict.deploys_from_sample, 10 * GetParam().threshold);
    }
  }
  EXPECT_GE(std::count(seen.both.begin(), seen.both.end(), true), 0.3 * kAsked)
      << "or they are of no use";
  RecordProperty("largest_share_of_a_bound", scientific(largest_share_));
}

INSTANTIATE_TEST_SUITE_P(Drawn, ShiftExpansions,
                         testing::Values(ExpandedSheet{6, 6, Shifted::interior, 170},
                                         ExpandedSheet{6, 6, Shifted::ring, 170},
                                         ExpandedSheet{4, 4, Shifted::interior, 150},
                                         ExpandedSheet{8, 6, Shifted::interior, 150}));

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
