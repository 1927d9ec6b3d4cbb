// What the fast tests see of a sheet is what its path shows there, within the errors they claim:
// lengths and slopes (by central differences) of the path in steps of a tenth of a degree.
#include "solver/lanes/lane_test.hpp"

#include <cmath>

#include "blocks.hpp"
#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {
namespace {

// Takes down what a test reports of one sheet.
struct Notes {
  bool seen = false;
  std::vector<double> lengths, slopes;
  double length_error = 0, slope_error = 0;

  void set_flat(int, const double*) {}
  bool decided(int) const { return true; }
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

struct NothingKept {
  FoldState<double>& keep(int, OpenSheet&) { return state; }
  FoldState<double> state;
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

  // Rows of lengths in panel widths, a tenth of a degree apart up to the far test and one more.
  Eigen::MatrixXd lengths_along_path(int sheet) const {
    PathPlanOptions fine;
    fine.sample_deg = 0.1;
    fine.end_deg = model_.tests()[0].sample + 0.1;
    const auto history = sheets_.history(sheets_.vertices(block_, sheet), fine);
    return history.length_mm / sheets_.mechanism.panel_width_mm;
  }

  template <class Real>
  void compare() {
    LaneTest<Real> lanes(model_);
    const int diagonals = sheets_.mechanism.diagonal_count();
    int seen = 0, looks = 0;
    double most_left = 0;  // of a slope's error, over the correction that bounds it
    std::vector<double> length_errors, slope_errors;
    for (int sheet = 0; sheet < kSheets; ++sheet) {
      const Eigen::MatrixXd path = lengths_along_path(sheet);
      for (int test = 0; test < static_cast<int>(model_.tests().size()); ++test) {
        ++looks;
        const Eigen::Index row = 10 * model_.tests()[test].sample - 1;
        if (row + 1 >= path.rows()) continue;  // the path ended before
        Notes notes;
        notes.lengths.resize(diagonals);
        std::vector<OpenSheet> open = {{sheet, -1}};
        NothingKept nothing{flat_state<double>(sheets_.mechanism)};
        lanes.run(test, block_, open, notes, nothing);
        if (!notes.seen) continue;
        ++seen;
        length_errors.push_back(notes.length_error);
        for (int d = 0; d < diagonals; ++d) {
          EXPECT_NEAR(notes.lengths[d], path(row, d), notes.length_error)
              << "sheet " << sheet << ", test " << test << ", diagonal " << d;
        }
        if (notes.slopes.empty()) continue;
        slope_errors.push_back(notes.slope_error);
        const double floors =
            slope_error(0) + rounding_error(std::numeric_limits<Real>::epsilon(), model_.extent(),
                                            model_.tests()[test]);
        for (int d = 0; d < diagonals; ++d) {
          const double slope = (path(row + 1, d) - path(row - 1, d)) / (0.2 * kRadPerDeg);
          const double left = std::abs(notes.slopes[d] - slope) - kDifferenceError - floors;
          most_left = std::max(
              most_left, left * (slope_error(1) - slope_error(0)) / (notes.slope_error - floors));
          EXPECT_NEAR(notes.slopes[d], slope, notes.slope_error + kDifferenceError)
              << "sheet " << sheet << ", test " << test << ", diagonal " << d;
        }
      }
    }
    EXPECT_GE(seen, 0.95 * looks);
    // Narrow enough to be of use: diagonals move by 5e-3 panel widths, slopes are as large.
    std::nth_element(length_errors.begin(), length_errors.begin() + seen / 2, length_errors.end());
    EXPECT_LE(length_errors[seen / 2], 1e-3);
    const auto middle = slope_errors.begin() + static_cast<std::ptrdiff_t>(slope_errors.size() / 2);
    std::nth_element(slope_errors.begin(), middle, slope_errors.end());
    EXPECT_LE(*middle, 2e-3);
    RecordProperty("most_left_of_a_correction", scientific(most_left));
  }

  static constexpr int kSheets = 60 / kFewer;
  // Of central differences over a tenth of a degree: h^2 / 6 of third derivatives up to 10.
  static constexpr double kDifferenceError = 5e-6;
  const DrawableSheet sheets_;
  const Model model_;
  const ShiftBlock block_;
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
