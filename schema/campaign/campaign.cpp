#include "schema/campaign/campaign.hpp"

#include <cmath>

namespace misalign::schema {

int Campaign::threshold_sample() const {
  return static_cast<int>(std::lround(threshold_deg / sample_deg));
}

solver::Criterion Campaign::criterion() const {
  if (!required_stop) return {between_samples, 0, 0};
  const double width_mm = pattern.base.sheet.panel_width_mm;
  return {between_samples, static_cast<int>(std::lround(required_stop->at_deg / sample_deg)),
          required_stop->least_mm2_per_rad2 / (width_mm * width_mm)};
}

bool Campaign::accepts(const solver::Verdict& verdict) const {
  return verdict.first_fault != solver::Fault::undecided &&
         verdict.deploys_from_sample >= threshold_sample();
}

}  // namespace misalign::schema
