// The folding of the correct (unshifted, unperforated) sheet: the starting values of every path.
#pragma once

#include <vector>

#include "solver/crease_pattern.hpp"
#include "solver/half_angle.hpp"

namespace misalign::solver {

/// All fold angles of a flat-foldable sheet follow from the pilot's by constant ratios:
/// tan(rho_e / 2) = ratio_e * tan(rho_1 / 2), valley positive, mountain negative.
struct BaseFolding {
  std::vector<double> tangent_ratio;  ///< one per edge of the sheet; 0 on the perimeter
  int pilot_edge;                     ///< |ratio| = 1 here

  /// Half of the fold angle of `edge` when the pilot's |fold angle| has half angle `pilot`.
  HalfAngle<double> half_angle(int edge, const HalfAngle<double>& pilot) const {
    return half_angle_of_ratio(tangent_ratio[edge] * pilot.s, pilot.c);
  }
};

}  // namespace misalign::solver
