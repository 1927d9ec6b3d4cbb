// Gives the ends of springs on a folded shape, from its coordinates alone.
#pragma once

#include <Eigen/Geometry>

#include "solver/kinematics/mechanism.hpp"

namespace misalign::solver {

/// Ends of a diagonal's spring, mm: at its corner `from` and at `to`.
struct FoldedSpring {
  Eigen::Vector3d from_mm, to_mm;

  FoldedSpring(const Mechanism& mechanism, const Diagonal& diagonal,
               const Eigen::Matrix3Xd& shape_mm)
      : from_mm(end_mm(mechanism, diagonal, diagonal.from_corner, shape_mm)),
        to_mm(end_mm(mechanism, diagonal, diagonal.to_corner, shape_mm)) {}
  double length_mm() const { return (from_mm - to_mm).norm(); }

 private:
  static Eigen::Vector3d end_mm(const Mechanism& mechanism, const Diagonal& diagonal, int corner,
                                const Eigen::Matrix3Xd& shape_mm) {
    const Loop& loop = mechanism.loops[static_cast<std::size_t>(diagonal.loop)];
    const auto k = static_cast<std::size_t>(corner);
    const Eigen::Vector3d at_mm = shape_mm.col(loop.corners[k]);
    if (mechanism.springs.at_vertices()) return at_mm;
    const Loop::Carrier& carrier = loop.carriers[k];
    const Eigen::Vector3d before = (shape_mm.col(carrier.before) - at_mm).normalized(),
                          after = (shape_mm.col(carrier.after) - at_mm).normalized();
    const Eigen::Vector3d along = (before + after).normalized(),
                          up = after.cross(before).normalized();
    return at_mm + carrier.place_mm.x() * along + carrier.place_mm.y() * up.cross(along) +
           carrier.place_mm.z() * up;
  }
};

}  // namespace misalign::solver
