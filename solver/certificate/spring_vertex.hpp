// A proof's sheet has the ends of springs beside the vertices, as points after its vertices.
#pragma once

#include "solver/kinematics/mechanism.hpp"

namespace misalign::solver {

/// The index of the end at a corner of a hole, among the flat sheet's points.
inline int spring_vertex(const Mechanism& mechanism, int loop, int corner) {
  return mechanism.springs.at_vertices() ? mechanism.loops[static_cast<std::size_t>(loop)]
                                               .corners[static_cast<std::size_t>(corner)]
                                         : mechanism.vertices + 4 * loop + corner;
}

/// Calls use(passage) for every joint between the panels that carry the ends of a diagonal's
/// spring, in the order of the loop from one to the other.
template <class Use>
void each_passage_between_ends(const Mechanism& mechanism, const Diagonal& diagonal, Use&& use) {
  const Loop& loop = mechanism.loops[static_cast<std::size_t>(diagonal.loop)];
  const auto arrival = [&](int corner) {
    return static_cast<std::size_t>(loop.carriers[static_cast<std::size_t>(corner)].arrival);
  };
  const std::size_t count = loop.passages.size(), end = arrival(diagonal.to_corner) % count;
  for (std::size_t j = arrival(diagonal.from_corner) % count; j != end; j = (j + 1) % count) {
    use(loop.passages[j]);
  }
}

}  // namespace misalign::solver
