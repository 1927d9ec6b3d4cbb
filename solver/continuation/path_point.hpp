// What was found at a station of one path.
#pragma once

#include <vector>

#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

struct PathPoint {
  explicit PathPoint(const Mechanism& mechanism);
  ~PathPoint();

  FoldState<double> state;
  std::vector<double> lengths, slopes;  ///< of the diagonals: panel widths, per radian of pilot
  double pilot_rate = 1;                ///< the pilot's entry of the unit tangent
  double misfit =
      0;  ///< how far the tangent is from one, per radian of pilot: what slopes are worth
};

}  // namespace misalign::solver
