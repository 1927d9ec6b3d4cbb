// Makes the filling of a sheet from its way or its history.
#pragma once

#include "solver/fill/filling.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// Sign of each diagonal's change next to flat, and up to D: 1 longer, -1 shorter.
Eigen::VectorXd sides_of_diagonals(const FoldingWay& way);

/// The filling of a sheet. Angles at which it is relaxed must lie on the way.
Filling filling_on(const FoldingWay& way, const Fill& fill);
/// The same by the sheet's history where the filling is relaxed flat: the sheet needs no way then.
Filling filling_of(const Sheet& sheet, const Fill& fill);

}  // namespace misalign::solver
