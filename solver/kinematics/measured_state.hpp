// Measures the rotations of all joints on a folded sheet whose vertices are given in space.
#pragma once

#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// Each panel has the pose that fits its corners best (least squares; Kabsch 1976); `folded_mm` are
/// 3 x vertices, seen from +z. Creases are within 180 degrees of flat. Loops close as well as the
/// panels fit.
FoldState<double> measured_state(const Mechanism& mechanism, const CreasePattern& sheet,
                                 const Eigen::Matrix3Xd& folded_mm);

}  // namespace misalign::solver
