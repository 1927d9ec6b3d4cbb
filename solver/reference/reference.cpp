#include "solver/reference/reference.hpp"

#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {

Reference::Reference(const Mechanism& mechanism, const PathPlan& plan)
    : mechanism_(mechanism),
      plan_(plan),
      tracker_(mechanism),
      judge_(mechanism),
      lengths_(mechanism.diagonals.size()) {}

Verdict Reference::judge(const FlatVertices& vertices_mm) {
  place(mechanism_, vertices_mm, geometry_);
  flat_lengths(mechanism_, geometry_, lengths_.data());
  judge_.begin(lengths_);
  path_ = tracker_.follow(geometry_, plan_, [&](const Stop& stop, const FoldState<double>& state) {
    if (stop.sample == 0) return true;
    folded_lengths(mechanism_, geometry_, state, lengths_.data());
    return judge_.see(stop, state, lengths_);
  });
  return judge_.conclude(path_);
}

}  // namespace misalign::solver
