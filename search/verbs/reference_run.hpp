// The frozen reference on a campaign's draws: what lanes are compared with.
#pragma once

#include "search/draws/draw.hpp"
#include "solver/reference/reference.hpp"

namespace misalign::search {

// Where the reference and the lanes differ, the reference goes again in shorter and shorter steps:
// it can cross a fold limit to another branch without a crease moving by 20 degrees (of 100,000 of
// 4 x 4 in steps of 1 degree 47, of 0.02 two, of 0.002 one).
inline constexpr double kCarefulSteps_deg[] = {0.02, 0.002, 0.0002};

class ReferenceRun {
 public:
  ReferenceRun(const schema::Campaign& campaign, const solver::Mechanism& mechanism,
               double longest_step_deg = solver::PathPlanOptions{}.longest_step_deg)
      : campaign_(campaign),
        base_(campaign.pattern.base),
        plan_(solver::plan_path(
            mechanism, base_.folding, base_.sheet.vertices_mm,
            solver::reference_path(campaign.path(), longest_step_deg, campaign.between_samples))),
        reference_(mechanism, plan_, campaign.criterion()) {}

  solver::Verdict judge(std::uint64_t draw) {
    return reference_.judge(base_.sheet.vertices_mm + shifts_of_draw(campaign_, draw));
  }
  const solver::PathResult& path() const { return reference_.path(); }

 private:
  const schema::Campaign& campaign_;
  const solver::PerforatedSheet& base_;
  const solver::PathPlan plan_;
  solver::Reference reference_;
};

}  // namespace misalign::search
