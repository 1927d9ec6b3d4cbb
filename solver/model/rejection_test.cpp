#include "solver/model/rejection_test.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

std::optional<double> newton_error(double first_correction_rad, double second_correction_rad,
                                   double length_per_rad) {
  const double ratio = second_correction_rad / first_correction_rad;
  if (!(ratio < kRejection.largest_ratio)) return std::nullopt;
  return length_per_rad * kRejection.safety * ratio * ratio * second_correction_rad;
}

double rounding_error(double epsilon, double extent, const TestPlace& test) {
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

double step_ahead_deg(double pilot_deg, double far_deg) {
  constexpr double kBeyondFar_deg = 2.5;
  return std::clamp(kBeyondFar_deg + (far_deg - pilot_deg) / 4, kBeyondFar_deg, kLongestStep_deg);
}

double farthest_between(double from_deg, double from_rate, double to_deg, double to_rate,
                        double step) {
  const double farthest = std::max(from_deg, to_deg);
  if (!(to_rate < 0 && from_rate > 0)) return farthest;
  const double meet = (to_deg - from_deg - to_rate * step) / (from_rate - to_rate);
  return farthest + 1.5 * std::max(0.0, from_deg + from_rate * meet - farthest);
}

double norm_of(const std::vector<double>& vector) {
  return std::sqrt(std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.0));
}

RejectionTest::RejectionTest(const Model& model)
    : model_(model),
      diagonals_(model.mechanism().diagonals.size()),
      threshold_deg_(model.threshold_sample() * model.sample_deg()),
      slopes_until_deg_(last_sample_of_slopes(model.threshold_sample(), model.sample_deg()) *
                        model.sample_deg()) {
  if (model.criterion().energy) energy_.emplace(model);
}

RejectionTest::~RejectionTest() = default;

void RejectionTest::begin(int sheets) {
  const std::size_t count = static_cast<std::size_t>(sheets);
  rejections_.assign(count, {});
  flat_.resize(count * diagonals_);
  earlier_.resize(count * diagonals_);
  earlier_deg_.assign(count, 0);
  earlier_exact_.assign(count, false);
  earlier_error_.assign(count, 0);
  direction_.assign(count * diagonals_, 0);
  if (energy_) energy_->begin(sheets);
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

int RejectionTest::next_sample(double pilot_deg) const {
  // Energies are compared at samples, a step apart.
  if (holds_every_step()) {
    constexpr double kShare = 0.8;  // of a step: a sheet's pilot may be slower than the base's
    const double far_deg = model_.tests()[0].pilot_deg;
    const double to_deg = pilot_deg + kShare * step_ahead_deg(pilot_deg, far_deg);
    const int next = static_cast<int>(pilot_deg / model_.sample_deg() * (1 + 1e-12)) + 1;
    return std::min(model_.threshold_sample(),
                    std::max(next, static_cast<int>(to_deg / model_.sample_deg())));
  }
  return std::max(last_sample_of_slopes(model_.threshold_sample(), model_.sample_deg()),
                  static_cast<int>(pilot_deg / model_.sample_deg() * (1 + 1e-12)) + 1);
}

bool RejectionTest::observe(int sheet, const Observation& seen) {
  assert(sheet >= 0 && static_cast<std::size_t>(sheet) < rejections_.size());
  if (decided(sheet)) return false;
  if (seen.pilot_rate < -kRejection.certain_turn_slope_errors * seen.slope_error &&
      seen.farthest_deg < threshold_deg_ - kRejection.certain_limit_deg) {
    rejections_[sheet] = {Fault::fold_limit, sample_of(seen.pilot_deg)};
    return false;
  }
  if (!(seen.pilot_rate > 0 && seen.pilot_deg <= threshold_deg_)) return false;
  if (seen.sample == 0 && !(seen.pilot_deg <= slopes_until_deg_)) return true;
  const Fault fault = fault_of(sheet, seen);
  if (fault != Fault::none) {
    rejections_[sheet] = {fault, sample_of(seen.pilot_deg)};
    return false;
  }
  earlier_deg_[sheet] = seen.pilot_deg;
  earlier_exact_[sheet] = seen.sample > 0;
  earlier_error_[sheet] = seen.length_error;
  std::copy_n(seen.lengths, diagonals_,
              earlier_.begin() + static_cast<std::ptrdiff_t>(sheet * diagonals_));
  return seen.pilot_deg < threshold_deg_;
}

Fault RejectionTest::fault_of(int sheet, const Observation& seen) {
  const double* const flat = flat_.data() + static_cast<std::size_t>(sheet) * diagonals_;
  if (energy_) return energy_->fault_of(sheet, seen, flat);
  return sees_both(sheet, seen) ? Fault::not_monotone : Fault::none;
}

bool RejectionTest::sees_both(int sheet, const Observation& now) {
  const std::size_t first = static_cast<std::size_t>(sheet) * diagonals_;
  const bool has_earlier =
      earlier_deg_[sheet] > 0 &&
      std::abs(earlier_deg_[sheet] - now.pilot_deg) > (1 - 1e-9) * model_.sample_deg();
  const double since = now.pilot_deg > earlier_deg_[sheet] ? 1 : -1;
  // Beyond this margin at least one step between samples is longer than the band.
  const double flat_margin = now.length_error + kStepBand_widths * model_.threshold_sample();
  const double earlier_margin = flat_margin + earlier_error_[sheet];
  const bool slopes_count = model_.sample_deg() <= kRejection.longest_sample_for_slopes_deg &&
                            now.pilot_deg <= slopes_until_deg_;
  const double slope_margin =
      now.slope_error + kRejection.least_slope_widths_per_deg / kRadPerDeg * now.pilot_rate;
  // Allows for a diagonal's further motion up to a sample.
  const double of_a_sample = model_.sample_deg() * kRadPerDeg / now.pilot_rate;
  const int ways = now.sample > 0 ? 0 : 1;
  const int ways_since = now.sample > 0 && earlier_exact_[sheet] ? 0 : 2;
  for (std::size_t i = 0; i < diagonals_; ++i) {
    bool grows = direction_[first + i] > 0, shrinks = direction_[first + i] < 0;
    const auto moved = [&](double change, double margin) {
      grows = grows || change > margin;
      shrinks = shrinks || change < -margin;
    };
    const double next = (std::abs(now.slopes[i]) + now.slope_error) * of_a_sample;
    moved(now.lengths[i] - flat_[first + i], flat_margin + ways * next);
    if (has_earlier) {
      moved(since * (now.lengths[i] - earlier_[first + i]), earlier_margin + ways_since * next);
    }
    if (slopes_count) moved(now.slopes[i], slope_margin);
    if (grows && shrinks) return true;
    direction_[first + i] = static_cast<signed char>(grows ? 1 : shrinks ? -1 : 0);
  }
  return false;
}

void RejectionTest::observe(int sheet, double pilot_deg, const FoldState<double>& state) {
  if (decided(sheet) || !(pilot_deg <= threshold_deg_)) return;
  constexpr double least_cosine = kLeastCosine - kRejection.fold_angle_rad;
  const std::vector<Crease>& creases = model_.mechanism().creases;
  assert(state.creases.size() == creases.size());
  for (std::size_t k = 0; k < creases.size(); ++k) {
    if (state.creases[k].c < least_cosine) {
      rejections_[sheet] = {Fault::over_folded, sample_of(pilot_deg)};
    }
    if (state.creases[k].s * creases[k].assignment < -kRejection.fold_angle_rad) {
      rejections_[sheet] = {Fault::assignment_flipped, sample_of(pilot_deg)};
    }
  }
}

}  // namespace misalign::solver
