// Finds where diagonals hardly change.
#pragma once

#include <vector>

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// Rate of a diagonal, positive in the direction of its whole change, over the sine of the pilot's
/// angle, which makes it comparable from flat on.
struct LowSlope {
  Eigen::Index diagonal;
  double pilot_deg, mm_per_deg;
};

/// Local minima for each diagonal up to this angle; the sheet must have a way.
std::vector<LowSlope> low_slopes(const Sheet& sheet, double to_deg);
/// The least of these slopes.
double least_slope_mm_per_deg(const Sheet& sheet, double to_deg);

}  // namespace misalign::solver
