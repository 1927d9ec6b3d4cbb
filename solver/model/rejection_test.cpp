#include "solver/model/rejection_test.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace misalign::solver {

std::optional<double> newton_error(double first_correction_rad, double second_correction_rad,
                                   double length_per_rad) {
  const double ratio = second_correction_rad / first_correction_rad;
  if (!(ratio < kRejection.largest_ratio)) return std::nullopt;
  return length_per_rad * kRejection.safety * ratio * ratio * second_correction_rad;
}

std::optional<double> chord_error(double first_correction_rad, double second_correction_rad,
                                  double length_per_rad) {
  const double ratio = second_correction_rad / first_correction_rad;
  if (!(ratio < kRejection.largest_ratio)) return std::nullopt;
  return length_per_rad * kRejection.safety * ratio * second_correction_rad;
}

double rounding_error(double epsilon, double extent, const TestAngle& test) {
  const std::size_t equations = static_cast<std::size_t>(test.factors.plan().equations);
  assert(test.lengths_per_closure.size() % equations == 0);
  double most = 0;
  for (auto row = test.lengths_per_closure.begin(); row != test.lengths_per_closure.end();
       row += static_cast<std::ptrdiff_t>(equations)) {
    const double sum =
        std::accumulate(row, row + static_cast<std::ptrdiff_t>(equations), 0.0,
                        [](double all, double share) { return all + std::abs(share); });
    most = std::max(most, sum);
  }
  return kRejection.safety * most * epsilon * extent + kRejection.path_length_widths;
}

double slope_error(double correction) {
  return kRejection.slope_safety * correction + kRejection.path_slope_widths_per_rad;
}

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
  assert(sheet >= 0 && static_cast<std::size_t>(sheet) < rejections_.size());
  std::copy_n(lengths, diagonals_, flat_.begin() + static_cast<std::ptrdiff_t>(sheet * diagonals_));
}

void RejectionTest::expect(int sheet, const signed char* directions, bool both, int sample) {
  if (both) rejections_[sheet] = {Fault::not_monotone, sample};
  std::copy_n(directions, diagonals_,
              direction_.begin() + static_cast<std::ptrdiff_t>(sheet * diagonals_));
}

void RejectionTest::observe(int sheet, const Observation& observation) {
  assert(sheet >= 0 && static_cast<std::size_t>(sheet) < rejections_.size());
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
  const bool slopes_count =
      now.slopes && model_.sample_deg() <= kRejection.longest_sample_for_slopes_deg &&
      now.sample <= last_sample_of_slopes(model_.threshold_sample(), model_.sample_deg());
  const double slope_margin = now.slope_error + kRejection.least_slope_widths_per_deg / kRadPerDeg;
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
  constexpr double least_cosine = kLeastCosine - kRejection.fold_angle_rad;
  const std::vector<Crease>& creases = model_.mechanism().creases;
  assert(state.creases.size() == creases.size());
  for (std::size_t k = 0; k < creases.size(); ++k) {
    if (state.creases[k].c < least_cosine) rejections_[sheet] = {Fault::over_folded, sample};
    if (state.creases[k].s * creases[k].assignment < -kRejection.fold_angle_rad) {
      rejections_[sheet] = {Fault::assignment_flipped, sample};
    }
  }
}

void RejectionTest::path_ended(int sheet, const PathResult& path) {
  const double threshold_deg = model_.threshold_sample() * model_.sample_deg();
  if (path.end == PathEnd::fold_limit &&
      path.fold_limit_deg < threshold_deg - kRejection.certain_limit_deg) {
    rejections_[sheet] = {Fault::fold_limit,
                          static_cast<int>(path.fold_limit_deg / model_.sample_deg()) + 1};
  }
}

}  // namespace misalign::solver
