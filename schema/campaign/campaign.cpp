#include "schema/campaign/campaign.hpp"

#include <cmath>

#include "solver/fill/certifiable.hpp"

namespace misalign::schema {

int Campaign::threshold_sample() const {
  return static_cast<int>(std::lround(threshold_deg / sample_deg));
}

solver::Criterion Campaign::criterion() const {
  solver::Criterion criterion{between_samples};
  if (required_stop) {
    const double width_mm = pattern.base.sheet.panel_width_mm;
    criterion.stop_sample = static_cast<int>(std::lround(required_stop->at_deg / sample_deg));
    criterion.least_stop_stiffness = required_stop->least_mm2_per_rad2 / (width_mm * width_mm);
  }
  if (energy) criterion.energy = energy->criterion(threshold_sample());
  return criterion;
}

bool Campaign::accepts(const solver::Verdict& verdict) const {
  return verdict.first_fault != solver::Fault::undecided &&
         verdict.deploys_from_sample >= threshold_sample();
}

void check_energy_acceptance(const Campaign& campaign, InputFaults& faults) {
  if (!campaign.energy) return;
  if (campaign.between_samples != solver::BumpRule::ignored) {
    faults.add("accept.between_samples", "is about single diagonals, and the energy is their sum",
               "write false, or accept.by = \"diagonals\"");
  }
  if (campaign.required_stop) {
    faults.add("accept.stops_at_deg",
               "springs that are relaxed there do not drive the sheet to flat, which accept.by = "
               "\"energy\" demands",
               "take the stop out, or write accept.by = \"diagonals\"");
  }
  if (campaign.search.optimisation) {
    faults.add("search.method = \"optimise\"",
               "ascends with springs of search.stiffness_n_per_mm, and accept.by = \"energy\" "
               "judges by accept.fill",
               "write \"plain\" or \"splitting\"");
  }
  if (campaign.search.shape) {
    faults.add("search.method = \"shape\"",
               "ends in sheets whose diagonals are all monotone, and accept.by = \"energy\" judges "
               "their sum",
               "write accept.by = \"diagonals\"");
  }
  const char* const why =
      solver::why_not_certifiable(campaign.energy->fill, campaign.pattern.base.springs);
  if (campaign.certify && why != nullptr) {
    faults.add("certify = true", why,
               "write false, or another accept.fill whose energy can be proven to rise");
  }
}

}  // namespace misalign::schema
