#include "solver/reference/reference.hpp"

#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {

Reference::Reference(const Mechanism& mechanism, const PathPlan& plan, BumpRule bumps)
    : mechanism_(mechanism),
      plan_(plan),
      tracker_(mechanism),
      bumps_(bumps),
      judge_(mechanism, bumps),
      dense_state_(mechanism),
      point_(mechanism) {}

Verdict Reference::judge(const FlatVertices& vertices_mm) {
  place(mechanism_, vertices_mm, geometry_);
  flat_lengths(mechanism_, geometry_, point_.lengths.data());
  judge_.begin(point_.lengths);
  path_ = tracker_.follow(geometry_, plan_,
                          [&](const Station& station, const FoldState<double>& state) {
                            if (station.sample == 0) return true;
                            if (bumps_ != BumpRule::ignored) {
                              dense_state_.find(geometry_, state, point_);
                              return judge_.see(station, &point_.state, point_.lengths,
                                                &point_.slopes, point_.pilot_rate);
                            }
                            folded_lengths(mechanism_, geometry_, state, point_.lengths.data());
                            return judge_.see(station, &state, point_.lengths);
                          });
  return judge_.conclude(path_);
}

}  // namespace misalign::solver
