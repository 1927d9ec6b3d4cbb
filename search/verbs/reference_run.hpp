// The frozen reference on a campaign's draws, with which lanes are compared.
#pragma once

#include <algorithm>

#include "search/draws/draw.hpp"
#include "solver/reference/grown_start.hpp"
#include "solver/reference/reference.hpp"

namespace misalign::search {

// The reference runs again where it differs from the lanes. Newton's method straight from
// the base folding finds no start or one on another branch where shifts are large (for two of five
// sheets of 8 x 6 with 8 mm), so its shifts grow step by step; and it can cross a fold limit to
// another branch without a crease moving by 20 degrees (of 100,000 of 4 x 4 in steps of 1 degree
// 47, of 0.02 two, of 0.002 one), so it goes in shorter and shorter steps.
inline constexpr double kCarefulSteps_deg[] = {solver::PathPlanOptions{}.longest_step_deg, 0.02,
                                               0.002, 0.0002};
// Nearer to flat a start is not known well enough for its shifts to grow: loops close to 1e-12,
// where the angles' squares are 3e-6.
inline constexpr double kLeastStart_deg = 0.1;

inline solver::PathPlan reference_plan(const schema::Campaign& campaign,
                                       const solver::Mechanism& mechanism,
                                       double longest_step_deg) {
  const solver::PerforatedSheet& base = campaign.pattern.base;
  return solver::plan_path(
      mechanism, base.folding, base.sheet.vertices_mm,
      solver::reference_path(campaign.path(), longest_step_deg, campaign.between_samples));
}

class ReferenceRun {
 public:
  ReferenceRun(const schema::Campaign& campaign, const solver::Mechanism& mechanism)
      : campaign_(campaign),
        plan_(reference_plan(campaign, mechanism, solver::PathPlanOptions{}.longest_step_deg)),
        reference_(mechanism, plan_, campaign.criterion()) {}

  solver::Verdict judge(std::uint64_t draw) {
    return reference_.judge(campaign_.pattern.base.sheet.vertices_mm +
                            shifts_of_draw(campaign_, draw));
  }
  const solver::PathResult& path() const { return reference_.path(); }

 private:
  const schema::Campaign& campaign_;
  const solver::PathPlan plan_;
  solver::Reference reference_;
};

/// One draw in steps of that length, with a start that its shifts have grown to.
inline solver::Verdict judge_carefully(const schema::Campaign& campaign,
                                       const solver::Mechanism& mechanism, double longest_step_deg,
                                       std::uint64_t draw) {
  const solver::PerforatedSheet& base = campaign.pattern.base;
  const solver::FlatVertices& base_mm = base.sheet.vertices_mm;
  const solver::FlatVertices vertices_mm = base_mm + shifts_of_draw(campaign, draw);
  solver::PathPlan plan = reference_plan(campaign, mechanism, longest_step_deg);
  plan.stations.erase(plan.stations.begin(),
                      std::ranges::find_if(plan.stations, [](const auto& station) {
                        return station.sample > 0 || station.pilot_deg >= kLeastStart_deg;
                      }));
  const solver::GrownStart start = solver::grow_start(
      mechanism, solver::base_state(mechanism, base.folding, base_mm, plan.stations.front().pilot),
      base_mm, vertices_mm);
  if (start.end != solver::PathEnd::end_reached) {
    const bool turns = start.end == solver::PathEnd::fold_limit;
    return {0, turns ? solver::Fault::fold_limit : solver::Fault::undecided, -1, start.end};
  }
  plan.start = start.state;
  return solver::Reference(mechanism, plan, campaign.criterion()).judge(vertices_mm);
}

}  // namespace misalign::search
