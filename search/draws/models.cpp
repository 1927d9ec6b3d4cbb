#include "search/draws/models.hpp"

namespace misalign::search {

solver::Model model_of(const schema::Campaign& campaign, double look_deg) {
  solver::PathPlanOptions path = campaign.path();
  path.look_deg = look_deg;
  const schema::Misalignment& misalignment = campaign.misalignment;
  return {campaign.pattern.base,
          misalignment.vertices,
          path,
          campaign.threshold_sample(),
          campaign.criterion(),
          misalignment.levels == schema::Levels::ternary ? misalignment.amplitude_mm : 0};
}

solver::Model model_of(const schema::Pattern& pattern, const schema::Sampling& sampling,
                       double look_deg) {
  return solver::Model(pattern.base, {sampling.sample_deg, sampling.end_deg, look_deg},
                       {sampling.between_samples});
}

}  // namespace misalign::search
