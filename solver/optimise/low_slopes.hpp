// Finds where diagonals hardly go on.
#pragma once

#include <vector>

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// How fast a diagonal goes the way that it goes on the whole, over the sine of the pilot's angle:
/// so it is of one size from flat on.
struct LowSlope {
  Eigen::Index diagonal;
  double pilot_deg, mm_per_deg;
};

/// Of each diagonal up to this angle, where that is less than beside it; of a sheet that has a way.
std::vector<LowSlope> low_slopes(const Sheet& sheet, double to_deg);
/// The least of them.
double least_slope_mm_per_deg(const Sheet& sheet, double to_deg);

}  // namespace misalign::solver
