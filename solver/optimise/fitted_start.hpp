// Fits the options of an optimisation to the sheet that it starts from.
#pragma once

#include "solver/optimise/optimise_options.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

/// The optimisation before its first step: the options as they fit the sheet, and the value of the
/// goal for it. Faults and reasons as of optimise().
StudyResult<Optimised> fitted_start(const Sheet& start, const OptimiseOptions& options);

}  // namespace misalign::solver
