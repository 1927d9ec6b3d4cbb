// The angle from which a sheet deploys, not of samples alone.
#pragma once

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// Every diagonal goes one way up to there, between samples too, and the sheet goes on folding.
double goes_until_deg(const Sheet& sheet);

}  // namespace misalign::solver
