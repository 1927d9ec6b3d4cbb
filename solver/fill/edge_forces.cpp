#include "solver/fill/edge_forces.hpp"

#include <Eigen/Geometry>
#include <cassert>

namespace misalign::solver {

Eigen::Matrix<double, 3, 4> edge_forces_n(const HoleEnergy& plate, const HoleCorners& corners_mm) {
  using Eigen::Vector3d;
  const Vector3d first_mm = corners_mm.col(2) - corners_mm.col(0),
                 second_mm = corners_mm.col(3) - corners_mm.col(1);
  const Vector3d normal_mm2 = first_mm.cross(second_mm);  // twice the area
  assert(normal_mm2.norm() > 0);
  // Forces at the ends of the diagonals, towards their other ends.
  const Vector3d along_first_n =
      plate.force_n(0) * first_mm.normalized() + plate.across_n_per_mm * second_mm;
  const Vector3d along_second_n =
      plate.force_n(1) * second_mm.normalized() + plate.across_n_per_mm * first_mm;
  Eigen::Matrix<double, 3, 4> forces_n;
  for (int k = 0; k < 4; ++k) {
    const Vector3d edge_mm = corners_mm.col((k + 1) % 4) - corners_mm.col(k);
    const Vector3d inwards_mm = 2 * normal_mm2.cross(edge_mm) / normal_mm2.squaredNorm();
    forces_n.col(k) =
        along_first_n * first_mm.dot(inwards_mm) + along_second_n * second_mm.dot(inwards_mm);
  }
  return forces_n;
}

}  // namespace misalign::solver
