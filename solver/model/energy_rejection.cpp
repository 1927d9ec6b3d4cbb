#include "solver/model/energy_rejection.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/rejection_tolerances.hpp"

namespace misalign::solver {

// The scores of a splitting search demand less before its end.
EnergyRejection::EnergyRejection(const Model& model)
    : model_(model),
      slopes_until_deg_(last_sample_of_slopes(model.threshold_sample(), model.sample_deg()) *
                        model.sample_deg()),
      energy_(model.mechanism(), model.criterion().energy->fill),
      flat_(model.mechanism().diagonals.size()),
      lengths_(flat_),
      forces_n_(flat_),
      stiffness_n_per_mm_(flat_) {
  const EnergyCriterion& criterion = *model.criterion().energy;
  if (judges() && model.threshold_sample() == criterion.from_sample) {
    friction_n_mm_per_mm_ = criterion.least_friction_n_mm_per_mm;
  }
}

void EnergyRejection::begin(int sheets) {
  const auto count = static_cast<std::size_t>(sheets);
  if (samples_.size() < count) samples_.resize(count);
  for (auto& of_sheet : samples_) of_sheet.clear();
}

// The energy falls on the way from flat if its rate is certainly negative, or from sample to
// sample. Its rise from a sample to the threshold, divided by the turning, bounds the critical
// friction.
Fault EnergyRejection::fault_of(int sheet, const ObservedState& now, const double* flat) {
  if (!judges()) return Fault::none;
  std::copy_n(flat, flat_.size(), flat_.begin());
  std::copy_n(now.lengths, flat_.size(), lengths_.begin());
  energy_.begin(flat_, nullptr);
  Sample seen{{energy_.look(lengths_, forces_n_, stiffness_n_per_mm_)}, {}};
  const double width_mm = model_.mechanism().panel_width_mm;
  const double error_mm = 2 * now.length_error * width_mm;  // of a length and its flat one
  double rate = 0, rate_error = 0;                          // per arc length
  const double least_slope = kRejection.least_slope_widths_per_deg / kRadPerDeg * now.pilot_rate;
  for (std::size_t d = 0; d < flat_.size(); ++d) {
    const double force_n = std::abs(forces_n_[d]), slope = std::abs(now.slopes[d]) * width_mm;
    const double force_error_n = stiffness_n_per_mm_[d] * error_mm;
    seen.energy_n_mm.error += (force_n + force_error_n) * error_mm;
    rate += forces_n_[d] * now.slopes[d] * width_mm;
    rate_error += force_error_n * slope +
                  (force_n + force_error_n) * (now.slope_error + least_slope) * width_mm;
  }
  const bool slopes_count = model_.sample_deg() <= kRejection.longest_sample_for_slopes_deg &&
                            now.pilot_deg <= slopes_until_deg_;
  if (slopes_count && rate < -rate_error) return Fault::energy_rises;
  if (now.sample == 0) return Fault::none;
  std::vector<Sample>& before = samples_[static_cast<std::size_t>(sheet)];
  for (const Sample& below : before) {
    if (seen.energy_n_mm.high() < below.energy_n_mm.low()) return Fault::energy_rises;
  }
  if (friction_n_mm_per_mm_ > 0) {
    const ObservedState::Creases creases = now.find_creases();
    // A diagonal is less exact than an angle (length_per_rad), and an angle is that of a half.
    seen.turning_mm = {creases.turning_mm,
                       2 * (kRejection.fold_angle_rad + now.length_error) * creases.all_mm};
    if (now.sample == model_.threshold_sample() && is_missed(seen, before)) {
      return Fault::weak_drive;
    }
  }
  before.push_back(seen);
  return Fault::none;
}

bool EnergyRejection::is_missed(const Sample& now, const std::vector<Sample>& before) const {
  DriveRatio drive;
  const auto take = [&](const Sample& below) {
    const double demanded = friction_n_mm_per_mm_;
    drive.take({now.energy_n_mm.value - below.energy_n_mm.value,
                now.energy_n_mm.error + below.energy_n_mm.error},
               {demanded * (now.turning_mm.value - below.turning_mm.value),
                demanded * (now.turning_mm.error + below.turning_mm.error)});
  };
  take({});  // flat
  for (const Sample& below : before) take(below);
  return drive.high < 1;
}

}  // namespace misalign::solver
