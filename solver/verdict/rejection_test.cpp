#include "solver/verdict/rejection_test.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace misalign::solver {
namespace {

// A slope counts when it carries the diagonal by more than this in one degree: a diagonal that
// turned round and back again within two degrees had smaller ones in 318,000 cases.
constexpr double kLeastSlope_widths_per_deg = 1e-6;

// Slopes speak of the samples next to theirs only if those are close.
constexpr double kLongestSampleForSlopes_deg = 2;

// A fold limit is taken for certain when it lies this far below the threshold.
constexpr double kLimitMargin_deg = 4 * kApproachTurn_deg;

// Fold angles of a converged state are better than this by far (rad).
constexpr double kAngleMargin_rad = 1e-8;

// Of the second correction to the first: beyond it, nothing is believed (2 of 1,000 sheets at 150
// degrees).
constexpr double kLargestRatio = 0.25;

// Room for the constant K, and for how much of a rounding shows in a diagonal (0.2 of it at most
// was seen), to be this much larger than they were found: there by the corrections, here on the
// base folding.
constexpr double kSafety = 10;

// The same for what is left of a slope's error, in corrections: the estimate that corrects it has
// the base folding's weights. Beside the floors 1.9 were seen in double precision, 4.0 in single,
// in 150,000 cases.
constexpr double kSlopeSafety = 5;

}  // namespace

std::optional<double> newton_error(double first_correction_rad, double second_correction_rad,
                                   double length_per_rad) {
  const double ratio = second_correction_rad / first_correction_rad;
  if (!(ratio < kLargestRatio)) return std::nullopt;
  return length_per_rad * kSafety * ratio * ratio * second_correction_rad;
}

std::optional<double> chord_error(double first_correction_rad, double second_correction_rad,
                                  double length_per_rad) {
  const double ratio = second_correction_rad / first_correction_rad;
  if (!(ratio < kLargestRatio)) return std::nullopt;
  return length_per_rad * kSafety * ratio * second_correction_rad;
}

double rounding_error(double epsilon, double extent, const TestAngle& test) {
  const std::size_t equations = static_cast<std::size_t>(test.factors.plan().equations);
  double most = 0;
  for (auto row = test.lengths_per_closure.begin(); row != test.lengths_per_closure.end();
       row += static_cast<std::ptrdiff_t>(equations)) {
    const double sum =
        std::accumulate(row, row + static_cast<std::ptrdiff_t>(equations), 0.0,
                        [](double all, double share) { return all + std::abs(share); });
    most = std::max(most, sum);
  }
  return kSafety * most * epsilon * extent + kPathLengthError;
}

double slope_error(double correction) { return kSlopeSafety * correction + kPathSlopeError; }

RejectionTest::RejectionTest(const Model& model)
    : model_(model), diagonals_(model.mechanism().diagonals.size()) {}

RejectionTest::~RejectionTest() = default;

void RejectionTest::begin(int sheets) {
  const std::size_t count = static_cast<std::size_t>(sheets);
  rejections_.assign(count, {});
  flat_.resize(count * diagonals_);
  earlier_.resize(count * diagonals_);
  earlier_sample_.assign(count, 0);
  earlier_error_.assign(count, 0);
  direction_.assign(count * diagonals_, 0);
}

void RejectionTest::set_flat(int sheet, const double* lengths) {
  std::copy_n(lengths, diagonals_, flat_.begin() + static_cast<std::ptrdiff_t>(sheet * diagonals_));
}

void RejectionTest::observe(int sheet, const Observation& observation) {
  if (sees_both(sheet, observation)) {
    rejections_[sheet] = {Fault::not_monotone, observation.sample};
    return;
  }
  earlier_sample_[sheet] = observation.sample;
  earlier_error_[sheet] = observation.length_error;
  std::copy_n(observation.lengths, diagonals_,
              earlier_.begin() + static_cast<std::ptrdiff_t>(sheet * diagonals_));
}

bool RejectionTest::sees_both(int sheet, const Observation& now) {
  const std::size_t first = static_cast<std::size_t>(sheet) * diagonals_;
  const bool has_earlier = earlier_sample_[sheet] > 0 && earlier_sample_[sheet] != now.sample;
  const double since = now.sample > earlier_sample_[sheet] ? 1 : -1;
  // Of so many steps one at least is longer than the band.
  const double flat_margin = now.length_error + kStepBand_widths * model_.threshold_sample();
  const double earlier_margin = flat_margin + earlier_error_[sheet];
  const bool slopes_count = now.slopes && model_.sample_deg() <= kLongestSampleForSlopes_deg &&
                            now.sample < model_.threshold_sample();
  const double slope_margin = now.slope_error + kLeastSlope_widths_per_deg / kRadPerDeg;
  for (std::size_t i = 0; i < diagonals_; ++i) {
    bool grows = direction_[first + i] > 0, shrinks = direction_[first + i] < 0;
    const auto moved = [&](double by, double margin) {
      grows = grows || by > margin;
      shrinks = shrinks || by < -margin;
    };
    moved(now.lengths[i] - flat_[first + i], flat_margin);
    if (has_earlier) moved(since * (now.lengths[i] - earlier_[first + i]), earlier_margin);
    if (slopes_count) moved(now.slopes[i], slope_margin);
    if (grows && shrinks) return true;
    direction_[first + i] = static_cast<signed char>(grows ? 1 : shrinks ? -1 : 0);
  }
  return false;
}

void RejectionTest::observe(int sheet, int sample, const FoldState<double>& state) {
  constexpr double least_cosine = -0.5 * kOverFoldBand_deg * kRadPerDeg - kAngleMargin_rad;
  const std::vector<Crease>& creases = model_.mechanism().creases;
  for (std::size_t k = 0; k < creases.size(); ++k) {
    if (state.creases[k].c < least_cosine) rejections_[sheet] = {Fault::over_folded, sample};
    if (state.creases[k].s * creases[k].assignment < -kAngleMargin_rad) {
      rejections_[sheet] = {Fault::assignment_flipped, sample};
    }
  }
}

void RejectionTest::path_ended(int sheet, const PathResult& path) {
  const double threshold_deg = model_.threshold_sample() * model_.sample_deg();
  if (path.end == PathEnd::fold_limit && path.fold_limit_deg < threshold_deg - kLimitMargin_deg) {
    rejections_[sheet] = {Fault::fold_limit,
                          static_cast<int>(path.fold_limit_deg / model_.sample_deg()) + 1};
  }
}

}  // namespace misalign::solver
