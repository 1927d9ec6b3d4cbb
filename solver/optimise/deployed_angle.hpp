// Finds the angle from which a sheet deploys, between samples too.
#pragma once

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// Largest pilot angle to which every diagonal is monotone, between samples too, and the sheet
/// folds on.
double goes_until_deg(const Sheet& sheet);

}  // namespace misalign::solver
