// Coordinates of the members of a parallel family.
#pragma once

#include "solver/pattern/parallel_family.hpp"

namespace misalign::solver {

/// Returns the coordinates of the member with these shifts; exact for a member.
inline Eigen::VectorXd coordinates_of(const ParallelFamily& family,
                                      const Eigen::Matrix2Xd& shifts_mm) {
  Eigen::VectorXd values(family.dimension());
  for (int k = 0; k < family.dimension(); ++k) {
    const ParallelCoordinate& coordinate = family.coordinates()[static_cast<std::size_t>(k)];
    if (coordinate.kind == ParallelCoordinate::Kind::shape) {
      values(k) = shifts_mm(coordinate.axis, coordinate.vertex);
      continue;
    }
    const HoleEdges change =
        hole_edges(family.holes()[static_cast<std::size_t>(coordinate.hole)], shifts_mm);
    values(k) =
        coordinate.kind == ParallelCoordinate::Kind::delta ? change.delta_mm : change.epsilon_mm;
  }
  return values;
}

}  // namespace misalign::solver
