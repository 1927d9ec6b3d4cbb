#include "solver/model/energy_rejection.hpp"

#include <cassert>
#include <cmath>

#include "solver/model/rejection_tolerances.hpp"

namespace misalign::solver {

// The scores of a splitting search demand less before its end.
EnergyRejection::EnergyRejection(const Model& model)
    : model_(model),
      slopes_until_deg_(last_sample_of_slopes(model.threshold_sample(), model.sample_deg()) *
                        model.sample_deg()) {
  assert(model.criterion().energy);
  const EnergyCriterion& criterion = *model.criterion().energy;
  const auto* const springs = std::get_if<Springs>(&criterion.fill);
  if (springs && springs->on == SpringsOn::all && !springs->preload.is_any() &&
      is_relaxed_flat(criterion.fill)) {
    const Eigen::VectorXd nowhere_mm = Eigen::VectorXd::Zero(model.mechanism().diagonal_count());
    const Filling filling(criterion.fill, model.mechanism().diagonals,
                          {nowhere_mm, nowhere_mm, nowhere_mm, {}});
    rates_n_per_mm_.assign(filling.rates_n_per_mm().begin(), filling.rates_n_per_mm().end());
    pull_only_ = springs->pull_only;
  }
  if (judges() && model.threshold_sample() == criterion.from_sample) {
    friction_n_mm_per_mm_ = criterion.least_friction_n_mm_per_mm;
  }
}

void EnergyRejection::begin(int sheets) {
  const auto count = static_cast<std::size_t>(sheets);
  if (samples_.size() < count) samples_.resize(count);
  for (auto& of_sheet : samples_) of_sheet.assign(1, {});
}

// The energy falls on the way from flat if its rate is certainly negative, or from sample to
// sample. Its rise from a sample to the threshold, divided by the turning, bounds the critical
// friction.
Fault EnergyRejection::fault_of(int sheet, const ObservedState& now, const double* flat) {
  if (!judges()) return Fault::none;
  assert(sheet >= 0 && sheet < std::ssize(samples_) && now.length_error >= 0);
  DrivenSample seen;
  const double width_mm = model_.mechanism().panel_width_mm;
  const double error_mm = 2 * now.length_error * width_mm;  // of a length and its flat one
  double rate = 0, rate_error = 0;                          // per arc length
  const double least_slope = kRejection.least_slope_widths_per_deg / kRadPerDeg * now.pilot_rate;
  for (std::size_t d = 0; d < rates_n_per_mm_.size(); ++d) {
    const double longer_mm = (now.lengths[d] - flat[d]) * width_mm;
    const double force_n = pull_only_ && longer_mm <= 0 ? 0 : rates_n_per_mm_[d] * longer_mm;
    const double slope = now.slopes[d] * width_mm, force_error_n = rates_n_per_mm_[d] * error_mm;
    const double most_n = std::abs(force_n) + force_error_n;
    seen.energy_n_mm.value += force_n * longer_mm / 2;
    seen.energy_n_mm.error += most_n * error_mm;
    rate += force_n * slope;
    rate_error +=
        force_error_n * std::abs(slope) + most_n * (now.slope_error + least_slope) * width_mm;
  }
  const bool slopes_count = model_.sample_deg() <= kRejection.longest_sample_for_slopes_deg &&
                            now.pilot_deg <= slopes_until_deg_;
  if (slopes_count && rate < -rate_error) return Fault::energy_rises;
  if (now.sample == 0) return Fault::none;
  std::vector<DrivenSample>& before = samples_[static_cast<std::size_t>(sheet)];
  for (const DrivenSample& below : before) {
    if (seen.energy_n_mm.high() < below.energy_n_mm.low()) return Fault::energy_rises;
  }
  if (friction_n_mm_per_mm_ > 0) {
    const ObservedState::Creases creases = now.find_creases();
    // A diagonal is less exact than an angle (length_per_rad), and an angle is that of a half.
    seen.turning_mm = {creases.turning_mm,
                       2 * (kRejection.fold_angle_rad + now.length_error) * creases.all_mm};
    if (now.sample == model_.threshold_sample() &&
        friction_ratio(seen, before, friction_n_mm_per_mm_).high < 1) {
      return Fault::weak_drive;
    }
  }
  before.push_back(seen);
  return Fault::none;
}

}  // namespace misalign::solver
