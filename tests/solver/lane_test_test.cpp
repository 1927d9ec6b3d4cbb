// The fast tests see of a sheet what its path shows there, within the errors they claim: lengths
// and slopes (by central differences of fourth order) of the path in steps of a tenth of a degree.
#include "solver/lanes/lane_test.hpp"

#include <cmath>

#include "blocks.hpp"
#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {
namespace {

// Takes down what a test reports of one sheet.
struct Notes {
  explicit Notes(Eigen::Index diagonals) : lengths(static_cast<std::size_t>(diagonals)) {}

  bool seen = false;
  std::vector<double> lengths, slopes;
  double length_error = 0, slope_error = 0;

  void set_flat(int, const double*) {}
  bool decided(int) const { return false; }
  void observe(int, int, const FoldState<double>&) {}
  void observe(int, const Observation& observation) {
    seen = true;
    lengths.assign(observation.lengths, observation.lengths + lengths.size());
    slopes.clear();
    if (observation.slopes) {
      slopes.assign(observation.slopes, observation.slopes + lengths.size());
    }
    length_error = observation.length_error;
    slope_error = observation.slope_error;
  }
};

// Keeps the state of the only sheet there is.
struct OneKept {
  explicit OneKept(const Mechanism& mechanism)
      : kept{nullptr, flat_state<double>(mechanism),
             std::vector<double>(static_cast<std::size_t>(mechanism.unknowns))} {}
  ApproachObserver::Kept& keep(Undecided&) { return kept; }
  ApproachObserver::Kept kept;
};

struct Case {
  int rows, columns;
  Shifted shifted;
  int threshold;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.rows << "x" << c.columns << " to " << c.threshold;
}

class LaneTestErrors : public testing::TestWithParam<Case> {
 protected:
  LaneTestErrors()
      : sheets_(GetParam().rows, GetParam().columns, GetParam().shifted),
        model_(sheets_.with_threshold(GetParam().threshold)),
        block_(sheets_.draws(kSheets, kSeed)) {}

  // Rows of lengths in panel widths, a tenth of a degree apart up to the last angle and two more.
  Eigen::MatrixXd lengths_along_path(int sheet) const {
    PathPlanOptions fine;
    fine.sample_deg = 0.1;
    const auto& last = model_.beyond().empty() ? model_.tests()[0] : model_.beyond().back();
    fine.end_deg = last.sample + 0.2;
    const auto history = sheets_.history(sheets_.vertices(block_, sheet), fine);
    return history.length_mm / sheets_.mechanism.panel_width_mm;
  }

  // Where the path gets there, what was seen of it.
  template <class Real>
  void compare(const TestAngle& angle, const Eigen::MatrixXd& path, const Notes& notes) {
    const Eigen::Index row = 10 * angle.sample - 1;
    if (row + 2 >= path.rows()) return;
    const bool is_test =
        &angle >= model_.tests().data() && &angle < model_.tests().data() + model_.tests().size();
    Share& share = is_test ? at_tests_ : ahead_;
    ++share.looks;
    if (!notes.seen) return;
    ++share.seen;
    length_errors_.push_back(notes.length_error);
    for (std::size_t d = 0; d < notes.lengths.size(); ++d) {
      const Eigen::Index column = static_cast<Eigen::Index>(d);
      EXPECT_NEAR(notes.lengths[d], path(row, column), notes.length_error)
          << angle.sample << " deg, diagonal " << d;
    }
    if (notes.slopes.empty()) return;
    slope_errors_.push_back(notes.slope_error);
    const double floors = slope_error(0) + rounding_error(std::numeric_limits<Real>::epsilon(),
                                                          model_.extent(), angle);
    for (std::size_t d = 0; d < notes.slopes.size(); ++d) {
      const Eigen::Index column = static_cast<Eigen::Index>(d);
      const auto by = [&](int k) { return path(row + k, column) - path(row - k, column); };
      const double slope = (8 * by(1) - by(2)) / (1.2 * kRadPerDeg);
      const double left = std::abs(notes.slopes[d] - slope) - kDifferenceError - floors;
      most_left_ = std::max(
          most_left_, left * (slope_error(1) - slope_error(0)) / (notes.slope_error - floors));
      EXPECT_NEAR(notes.slopes[d], slope, notes.slope_error + kDifferenceError)
          << angle.sample << " deg, diagonal " << d;
    }
  }

  // Each test by itself from the base folding; from the far one's state in single precision once
  // more in double precision, and on along the path.
  template <class Real>
  void compare() {
    LaneTest<Real> tests(model_, model_.tests());
    LaneTest<double> again(model_, model_.tests()), beyond(model_, model_.beyond());
    for (int sheet = 0; sheet < kSheets; ++sheet) {
      SCOPED_TRACE("sheet " + std::to_string(sheet));
      const Eigen::MatrixXd path = lengths_along_path(sheet);
      std::vector<Undecided> open = {{sheet, -1}};
      for (int k = static_cast<int>(model_.tests().size()) - 1; k >= 0; --k) {
        OneKept kept(sheets_.mechanism);
        Notes notes(path.cols());
        tests.run(k, true, block_, open, notes, kept);
        compare<Real>(model_.tests()[k], path, notes);
        if (k > 0 || !notes.seen || std::is_same_v<Real, double>) continue;
        Notes more(path.cols());
        again.run_again(0, block_, open, more, kept);
        compare<double>(model_.tests()[0], path, more);
        for (std::size_t i = 0; i < model_.beyond().size() && more.seen; ++i) {
          more = Notes(path.cols());
          beyond.run_ahead(static_cast<int>(i), block_, open, more, kept);
          compare<double>(model_.beyond()[i], path, more);
        }
      }
    }
    EXPECT_GE(at_tests_.seen, 0.95 * at_tests_.looks);
    EXPECT_GE(ahead_.seen, 0.8 * ahead_.looks) << "beyond 150 degrees limits are near";
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
  // Of central differences of fourth order: h^4 / 30 of fifth derivatives up to 1e6, next to
  // limits.
  static constexpr double kDifferenceError = 5e-7;
  const DrawableSheet sheets_;
  const Model model_;
  const ShiftBlock block_;
  struct Share {
    int seen = 0, looks = 0;
  } at_tests_, ahead_;
  double most_left_ = 0;  // of a slope's error, over the correction that bounds it
  std::vector<double> length_errors_, slope_errors_;
};

TEST_P(LaneTestErrors, SinglePrecision) { compare<float>(); }
TEST_P(LaneTestErrors, DoublePrecision) { compare<double>(); }

INSTANTIATE_TEST_SUITE_P(Drawn, LaneTestErrors,
                         testing::Values(Case{4, 4, Shifted::interior, 170},
                                         Case{6, 6, Shifted::interior, 170},
                                         Case{6, 6, Shifted::ring, 60},
                                         Case{8, 6, Shifted::interior, 120}));

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
