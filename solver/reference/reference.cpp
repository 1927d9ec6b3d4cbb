#include "solver/reference/reference.hpp"

#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {

Reference::Reference(const Mechanism& mechanism, const PathPlan& plan, bool bump_is_fault)
    : mechanism_(mechanism),
      plan_(plan),
      tracker_(mechanism),
      bump_is_fault_(bump_is_fault),
      judge_(mechanism, bump_is_fault),
      dense_state_(mechanism),
      point_(mechanism) {}

Verdict Reference::judge(const FlatVertices& vertices_mm) {
  place(mechanism_, vertices_mm, geometry_);
  flat_lengths(mechanism_, geometry_, point_.lengths.data());
  judge_.begin(point_.lengths);
  path_ = tracker_.follow(geometry_, plan_,
                          [&](const Station& station, const FoldState<double>& state) {
                            if (station.sample == 0) return true;
                            if (bump_is_fault_) {
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
