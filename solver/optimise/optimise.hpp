// The study of better sheets: from one, step by step, to shifts near its own with which it does
// better, until no step is found.
//
// With free shifts a step is a linear program: energies, the way each diagonal goes between
// neighbouring angles, elongations, fold limit and fold angles change as their gradients say
// (PathGradients), within a box that shrinks where that was wrong (a sequence of linear programs
// with a trust region). With ternary shifts a step changes one coordinate or two: the same
// gradients say which to evaluate first. Either way a sheet is taken only if it, folded itself,
// fits and does better.
//
// Where the goal is of rigid panels, every number that decides comes of additions, products,
// quotients and roots: the same sheet at the same steps, to the last bit, on every processor.
#pragma once

#include "solver/optimise/optimise_options.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

/// From `start`. Faults: of the angles as deploy(); amplitude_mm where its own shifts are larger or
/// not ternary, or there is none; grid_mm where they do not lie on it; deploys_from_deg,
/// stroke_limit, largest_force_n and floors where it does not keep them; goal where it has no
/// value. Reasons: overconstrained, path_lost.
StudyResult<Optimised> optimise(const Sheet& start, const OptimiseOptions& options);

/// The same before its first step: the options as they fit the sheet, and the value of the goal.
StudyResult<Optimised> fitted_start(const Sheet& start, const OptimiseOptions& options);

}  // namespace misalign::solver
