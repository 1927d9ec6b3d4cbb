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
  if (model.threshold_sample() == criterion.from_sample) {
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
  if (energy_.has_plates() || energy_.has_preload()) return Fault::none;
  const double width_mm = model_.mechanism().panel_width_mm;
  std::copy_n(flat, flat_.size(), flat_.begin());
  std::copy_n(now.lengths, flat_.size(), lengths_.begin());
  energy_.begin(flat_, nullptr);
  // A given free length leaves energy in the flat sheet.
  const double flat_n_mm = energy_.look(flat_, forces_n_, stiffness_n_per_mm_);
  const double error_mm = 2 * now.length_error * width_mm;  // of a length and its flat one
  Sample seen{now.sample, 0, 0, now.turning_mm};
  seen.energy_n_mm = energy_.look(lengths_, forces_n_, stiffness_n_per_mm_) - flat_n_mm;
  double rate = 0, rate_error = 0;  // per arc length
  const double least_slope = kRejection.least_slope_widths_per_deg / kRadPerDeg * now.pilot_rate;
  for (std::size_t d = 0; d < flat_.size(); ++d) {
    const double force_n = std::abs(forces_n_[d]), slope = std::abs(now.slopes[d]) * width_mm;
    const double force_error_n = stiffness_n_per_mm_[d] * error_mm;
    seen.error_n_mm += (force_n + force_error_n) * error_mm;
    rate += forces_n_[d] * now.slopes[d] * width_mm;
    rate_error += force_error_n * slope +
                  (force_n + force_error_n) * (now.slope_error + least_slope) * width_mm;
  }
  const bool slopes_count = model_.sample_deg() <= kRejection.longest_sample_for_slopes_deg &&
                            now.pilot_deg <= slopes_until_deg_;
  if (slopes_count && rate < -rate_error) return Fault::energy_rises;
  if (now.sample == 0) return Fault::none;
  std::vector<Sample>& before = samples_[static_cast<std::size_t>(sheet)];
  double creases_error_mm = 0;
  if (friction_n_mm_per_mm_ > 0) {
    // A diagonal is less exact than an angle (length_per_rad).
    creases_error_mm = (kRejection.fold_angle_rad + now.length_error) * 2 * now.turning_mm;
  }
  for (const Sample& below : before) {
    const double rise_n_mm = seen.energy_n_mm - below.energy_n_mm;
    const double error_n_mm = seen.error_n_mm + below.error_n_mm;
    if (below.sample < now.sample && rise_n_mm < -error_n_mm) return Fault::energy_rises;
  }
  if (now.sample < model_.threshold_sample() || friction_n_mm_per_mm_ == 0) {
    before.push_back(seen);
    return Fault::none;
  }
  const auto is_missed_from = [&](const Sample& below) {
    const double rise_n_mm =
        seen.energy_n_mm - below.energy_n_mm + seen.error_n_mm + below.error_n_mm;
    const double turning_mm = seen.turning_mm - below.turning_mm - 2 * creases_error_mm;
    return rise_n_mm < friction_n_mm_per_mm_ * turning_mm;
  };
  const bool is_missed =
      is_missed_from({0, 0, 0, 0}) || std::ranges::any_of(before, is_missed_from);
  return is_missed ? Fault::weak_drive : Fault::none;
}

}  // namespace misalign::solver
