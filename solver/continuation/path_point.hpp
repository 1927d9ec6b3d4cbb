// One lane's share of what a tracker found at a stop.
#pragma once

#include <vector>

#include "solver/kinematics/mechanism.hpp"

namespace misalign::solver {

struct StopCopy {
  explicit StopCopy(const Mechanism& mechanism);
  ~StopCopy();

  FoldState<double> state;
  std::vector<double> lengths, slopes;  ///< of the diagonals: panel widths, per radian of pilot
  double pilot_rate = 1;                ///< the pilot's entry of the unit tangent
};

}  // namespace misalign::solver
