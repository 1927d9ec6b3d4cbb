#include "search/draws/models.hpp"

namespace misalign::search {

namespace {

solver::Model model_of(const schema::Campaign& campaign, const solver::PathPlanOptions& path,
                       int threshold_sample, const solver::Criterion& criterion) {
  const schema::Misalignment& misalignment = campaign.misalignment;
  return {campaign.pattern.base,
          misalignment.vertices,
          path,
          threshold_sample,
          criterion,
          misalignment.levels == schema::Levels::ternary ? misalignment.amplitude_mm : 0};
}

}  // namespace

solver::Model model_of(const schema::Campaign& campaign, double look_deg) {
  solver::PathPlanOptions path = campaign.path();
  path.look_deg = look_deg;
  return model_of(campaign, path, campaign.threshold_sample(), campaign.criterion());
}

solver::Model scoring_model_of(const schema::Campaign& campaign, int sample) {
  solver::Criterion criterion = campaign.criterion();
  criterion.scores = true;
  return model_of(campaign, campaign.path(), sample, criterion);
}

solver::Model model_of(const schema::Pattern& pattern, const schema::Sampling& sampling,
                       double look_deg) {
  return solver::Model(pattern.base, {sampling.sample_deg, sampling.end_deg, look_deg},
                       {sampling.between_samples});
}

}  // namespace misalign::search
