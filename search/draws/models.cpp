#include "search/draws/models.hpp"

namespace misalign::search {

namespace {

solver::PathPlanOptions path_of(const schema::Sampling& sampling, const StationOptions& stations) {
  solver::PathPlanOptions path;
  path.sample_deg = sampling.sample_deg;
  path.end_deg = sampling.end_deg;
  path.look_deg = stations.step_deg;
  path.look_at_deg = stations.at_deg;
  return path;
}

solver::Model model_of(const schema::Campaign& campaign, const solver::PathPlanOptions& path,
                       int threshold_sample, const solver::Criterion& criterion) {
  const schema::Misalignment& misalignment = campaign.misalignment;
  return {campaign.pattern.base,
          misalignment.vertices,
          path,
          threshold_sample,
          criterion,
          misalignment.distribution == schema::ShiftDistribution::ternary
              ? misalignment.amplitude_mm
              : 0};
}

}  // namespace

solver::Model model_of(const schema::Campaign& campaign, const StationOptions& stations) {
  return model_of(campaign, path_of(campaign.sampling(), stations), campaign.threshold_sample(),
                  campaign.criterion());
}

solver::Model scoring_model_of(const schema::Campaign& campaign, int sample) {
  solver::Criterion criterion = campaign.criterion();
  criterion.scores = true;
  return model_of(campaign, campaign.path(), sample, criterion);
}

solver::Model model_of(const schema::Pattern& pattern, const schema::Sampling& sampling,
                       const StationOptions& stations) {
  return solver::Model(pattern.base, path_of(sampling, stations), sampling.criterion());
}

}  // namespace misalign::search
