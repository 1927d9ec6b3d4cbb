// Defines the folding of a base without a closed form: the path of a perforated sheet, followed
// from a folded state of it.
#pragma once

#include <vector>

#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {

template <class T>
struct FoldState;  // kinematics/fold_state.hpp

class FollowedFolding {
 public:
  virtual ~FollowedFolding() = default;

  /// Rotations of the perforated sheet's joints where |pilot fold angle| = 2 * `pilot`, from flat
  /// to the end of the path.
  virtual FoldState<double> state(const HalfAngle<double>& pilot) const = 0;
  /// Half fold angles of all edges there; zero at holes and on the perimeter.
  virtual std::vector<HalfAngle<double>> fold_angles(const HalfAngle<double>& pilot) const = 0;
};

}  // namespace misalign::solver
