#include "tests/bench/work_precision/problem.hpp"

#include "search/draws/draw.hpp"
#include "solver/reference/path_tracker.hpp"

namespace misalign::bench {

Problem::Problem(const schema::Campaign& campaign, int sheets)
    : base_(campaign.pattern.base), mechanism_(solver::build_mechanism(base_)) {
  const solver::PathPlan plan = solver::plan_path(
      mechanism_, base_.folding, base_.sheet.vertices_mm, {.sample_deg = 1, .end_deg = kEnd_deg});
  solver::PathTracker tracker(mechanism_);
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, base_.sheet.vertex_count());
  for (std::uint64_t draw = 0; static_cast<int>(sheets_.size()) < sheets; ++draw) {
    search::draw_shifts(campaign.misalignment, campaign.seed, draw, shifts_mm);
    Sheet sheet{draw, base_.sheet.vertices_mm + shifts_mm, {}};
    solver::place(mechanism_, sheet.vertices_mm, sheet.geometry);
    const solver::PathResult path = tracker.follow(
        sheet.geometry, plan,
        [](const solver::Station&, const solver::FoldState<double>&) { return true; });
    if (path.end == solver::PathEnd::end_reached) sheets_.push_back(std::move(sheet));
  }
}

solver::FoldState<double> Problem::base_state(double pilot_deg) const {
  return solver::base_state(mechanism_, base_.folding, base_.sheet.vertices_mm,
                            solver::half_angle_of_deg(pilot_deg));
}

}  // namespace misalign::bench
