// The fast tests see of a sheet what its path shows at the same pilot angle, within the errors they
// claim: lengths and slopes by polynomials through the path's samples, a tenth of a degree apart.
#include "solver/lanes/lane_test.hpp"

#include <cmath>

#include "solver/kinematics/diagonals.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

// Takes down what a test reports of one sheet; never decides.
struct Notes {
  explicit Notes(Eigen::Index diagonals) : lengths(static_cast<std::size_t>(diagonals)) {}

  bool seen = false;
  std::vector<double> lengths, slopes;
  double pilot_deg = 0, pilot_rate = 0, length_error = 0, slope_error = 0;

  void set_flat(int, const double*) {}
  bool decided(int) const { return false; }
  double slopes_until_deg() const { return 180; }
  int next_sample(double) const { return 180; }
  bool holds_every_step() const { return false; }
  void observe(int, double, const FoldState<double>&) {}
  bool observe(int, const RejectionTest::Observation& observation) {
    seen = true;
    lengths.assign(observation.lengths, observation.lengths + lengths.size());
    slopes.assign(observation.slopes, observation.slopes + lengths.size());
    pilot_deg = observation.pilot_deg;
    pilot_rate = observation.pilot_rate;
    length_error = observation.length_error;
    slope_error = observation.slope_error;
    return pilot_rate > 0;
  }
};

// The polynomial through six values a tenth of a degree apart, and its slope (per rad); and 20
// times how far that through the inner four is from them: more than what they are off, but where a
// pilot almost turns back ten times that was seen.
struct Interpolated {
  double value = 0, slope = 0, value_error = 0, slope_error = 0;

  Interpolated(const Eigen::MatrixXd& path, Eigen::Index column, double at_deg) {
    const Eigen::Index first = static_cast<Eigen::Index>(std::floor(10 * at_deg)) - 3;
    const double x = 10 * at_deg - 1 - static_cast<double>(first);
    const auto add = [&](int from, int end, double share, double& of_value, double& of_slope) {
      for (int i = from; i < end; ++i) {
        double weight = share, change = 0;
        for (int j = from; j < end; ++j) {
          if (j == i) continue;
          change = (change * (x - j) + weight) / (i - j);
          weight *= (x - j) / (i - j);
        }
        of_value += weight * path(first + i, column);
        of_slope += change * path(first + i, column) / (0.1 * kRadPerDeg);
      }
    };
    add(0, 6, 1, value, slope);
    add(1, 5, -1, value_error, slope_error);
    value_error = 20 * std::abs(value + value_error);
    slope_error = 20 * std::abs(slope + slope_error);
  }
};

struct LaneCase {
  int rows, columns;
  Shifted shifted;
  int threshold;
};
void PrintTo(const LaneCase& c, std::ostream* out) {
  *out << c.rows << "x" << c.columns << " to " << c.threshold;
}

class LaneTestErrors : public testing::TestWithParam<LaneCase> {
 protected:
  LaneTestErrors()
      : sheets_(GetParam().rows, GetParam().columns, GetParam().shifted),
        model_(sheets_.with_threshold(GetParam().threshold)),
        block_(sheets_.draws(kSheets, kSeed)) {}

  // Rows of lengths in panel widths, a tenth of a degree apart from 0.1 degrees on.
  Eigen::MatrixXd lengths_along_path(int sheet) const {
    PathPlanOptions fine;
    fine.sample_deg = 0.1;
    const auto history = sheets_.history(sheets_.vertices(block_, sheet), fine);
    return history.length_mm / sheets_.mechanism.panel_width_mm;
  }

  struct Share {
    int seen = 0, looks = 0;
  };
  // Where the path gets there, what was seen of it, against the path's own lengths and slopes.
  template <class Real>
  void compare(const TestPlace& place, const Eigen::MatrixXd& path, const Notes& notes,
               Share& share) {
    ++share.looks;
    if (!notes.seen) return;
    ++share.seen;
    if (!(notes.pilot_rate > 0) || 10 * notes.pilot_deg + 10 > static_cast<double>(path.rows())) {
      return;
    }
    length_errors_.push_back(notes.length_error);
    slope_errors_.push_back(notes.slope_error);
    const double floors = slope_error(0) + rounding_error(std::numeric_limits<Real>::epsilon(),
                                                          model_.extent(), place);
    for (std::size_t d = 0; d < notes.lengths.size(); ++d) {
      const Interpolated truth(path, static_cast<Eigen::Index>(d), notes.pilot_deg);
      EXPECT_NEAR(notes.lengths[d], truth.value, notes.length_error + truth.value_error + 1e-12)
          << notes.pilot_deg << " deg, diagonal " << d;
      const double off = std::abs(notes.slopes[d] - truth.slope * notes.pilot_rate) -
                         truth.slope_error * notes.pilot_rate;
      EXPECT_LE(off, notes.slope_error) << notes.pilot_deg << " deg, diagonal " << d;
      most_left_ = std::max(most_left_, (off - floors) * (slope_error(1) - slope_error(0)) /
                                            (notes.slope_error - floors));
    }
  }

  // Each test by itself from the base folding; from the far one's state in single precision once
  // more in double precision, and on along the path.
  template <class Real>
  void compare() {
    LaneTest<Real> tests(model_);
    LaneTest<double> again(model_);
    for (int sheet = 0; sheet < kSheets; ++sheet) {
      SCOPED_TRACE("sheet " + std::to_string(sheet));
      const Eigen::MatrixXd path = lengths_along_path(sheet);
      std::vector<Undecided> open = {{sheet, -1}};
      KeptStates kept(sheets_.mechanism);
      for (int k = static_cast<int>(model_.tests().size()) - 1; k >= 0; --k) {
        Notes notes(path.cols());
        tests.run(k, k == 0, block_, open, notes, kept);
        compare<Real>(model_.tests()[k], path, notes, at_tests_);
        if (k > 0 || !notes.seen || std::is_same_v<Real, double>) continue;
        Notes more(path.cols());
        again.run_again(0, block_, open, more, kept);
        compare<double>(model_.tests()[0], path, more, at_tests_);
        for (int steps = 0; steps < 6 && kept.of(open[0]).goes_on; ++steps) {
          more = Notes(path.cols());
          again.run_ahead(block_, open, more, kept);
          compare<double>(model_.tests()[0], path, more, ahead_);
        }
      }
    }
    EXPECT_GE(at_tests_.seen, 0.95 * at_tests_.looks);
    EXPECT_GE(ahead_.seen, 0.7 * ahead_.looks) << "next to limits steps are halved";
    // Narrow enough to be of use: diagonals move by 5e-3 panel widths, slopes are as large.
    EXPECT_LE(median(length_errors_), 1e-3);
    EXPECT_LE(median(slope_errors_), 2e-3);
    RecordProperty("most_left_of_a_correction", scientific(most_left_));
  }

  static double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  static constexpr int kSheets = 60 / kFewer;
  const DrawableSheet sheets_;
  const Model model_;
  const ShiftBlock block_;
  Share at_tests_, ahead_;
  double most_left_ = 0;  // of a slope's error, over the correction that bounds it
  std::vector<double> length_errors_, slope_errors_;
};

TEST_P(LaneTestErrors, SinglePrecision) { compare<float>(); }
TEST_P(LaneTestErrors, DoublePrecision) { compare<double>(); }

INSTANTIATE_TEST_SUITE_P(Drawn, LaneTestErrors,
                         testing::Values(LaneCase{4, 4, Shifted::interior, 170},
                                         LaneCase{6, 6, Shifted::interior, 170},
                                         LaneCase{6, 6, Shifted::ring, 60},
                                         LaneCase{8, 6, Shifted::interior, 120}));

// Against the dense Jacobian, with rates that belong to no path.
TEST(Slopes, MisfitIsTheJacobianTimesTheRates) {
  const DrawableSheet sheets(6, 6);
  const FoldState<double> state = sheets.folded(100);
  const int n = sheets.mechanism.equations;
  Eigen::VectorXd rates(sheets.mechanism.unknowns), misfit(n);
  for (int j = 0; j < rates.size(); ++j) rates[j] = std::sin(1.0 + j);
  std::vector<double> lengths(sheets.mechanism.diagonals.size()), slopes(lengths), same(lengths);
  folded_lengths_and_slopes(sheets.mechanism, sheets.geometry, state, rates.data(), lengths.data(),
                            slopes.data(), misfit.data());
  ClosureSystem system(sheets.mechanism);
  system.evaluate(sheets.geometry, state);
  EXPECT_LE((system.jacobian() * rates - misfit).norm(), 1e-12 * misfit.norm());
  folded_lengths(sheets.mechanism, sheets.geometry, state, same.data());
  EXPECT_EQ(lengths, same);
}

}  // namespace
}  // namespace misalign::solver
