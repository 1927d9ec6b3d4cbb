// The frozen reference on a campaign's draws: what lanes are compared with.
#pragma once

#include <algorithm>

#include "search/draws/draw.hpp"
#include "solver/reference/grown_start.hpp"
#include "solver/reference/reference.hpp"

namespace misalign::search {

// Where the reference and the lanes differ, the reference goes again. Newton's method straight from
// the base folding finds no start or one on another branch where shifts are large (for two of five
// sheets of 8 x 6 with 8 mm), so its shifts grow step by step; and it can cross a fold limit to
// another branch without a crease moving by 20 degrees (of 100,000 of 4 x 4 in steps of 1 degree
// 47, of 0.02 two, of 0.002 one), so it goes in shorter and shorter steps.
inline constexpr double kCarefulSteps_deg[] = {solver::PathPlanOptions{}.longest_step_deg, 0.02,
                                               0.002, 0.0002};
// Nearer to flat a start is not known well enough for its shifts to grow: loops close to 1e-12,
// where the angles' squares are 3e-6.
inline constexpr double kLeastStart_deg = 0.1;

class ReferenceRun {
 public:
  ReferenceRun(const schema::Campaign& campaign, const solver::Mechanism& mechanism,
               double longest_step_deg = solver::PathPlanOptions{}.longest_step_deg)
      : campaign_(campaign),
        mechanism_(mechanism),
        base_(campaign.pattern.base),
        plan_(solver::plan_path(
            mechanism, base_.folding, base_.sheet.vertices_mm,
            solver::reference_path(campaign.path(), longest_step_deg, campaign.between_samples))),
        reference_(mechanism, plan_, campaign.criterion()) {}

  solver::Verdict judge(std::uint64_t draw) {
    return reference_.judge(base_.sheet.vertices_mm + shifts_of_draw(campaign_, draw));
  }
  /// The same with a start that its shifts have grown to.
  solver::Verdict judge_grown(std::uint64_t draw) const {
    const solver::FlatVertices& base_mm = base_.sheet.vertices_mm;
    const solver::FlatVertices vertices_mm = base_mm + shifts_of_draw(campaign_, draw);
    const auto is_start = [](const solver::Station& station) {
      return station.sample > 0 || station.pilot_deg >= kLeastStart_deg;
    };
    solver::PathPlan plan{{std::ranges::find_if(plan_.stations, is_start), plan_.stations.end()},
                          plan_.start};
    const solver::GrownStart start = solver::grow_start(
        mechanism_,
        solver::base_state(mechanism_, base_.folding, base_mm, plan.stations.front().pilot),
        base_mm, vertices_mm);
    if (start.end != solver::PathEnd::end_reached) {
      const bool turns = start.end == solver::PathEnd::fold_limit;
      return {0, turns ? solver::Fault::fold_limit : solver::Fault::undecided, -1, start.end};
    }
    plan.start = start.state;
    return solver::Reference(mechanism_, plan, campaign_.criterion()).judge(vertices_mm);
  }
  const solver::PathResult& path() const { return reference_.path(); }

 private:
  const schema::Campaign& campaign_;
  const solver::Mechanism& mechanism_;
  const solver::PerforatedSheet& base_;
  const solver::PathPlan plan_;
  solver::Reference reference_;
};

}  // namespace misalign::search
