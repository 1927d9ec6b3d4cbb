// The study of optimisation: from one sheet, step by step, to nearby shifts that raise the goal,
// until no step does.
//
// Free shifts: a step is a linear program in energies, the diagonals' changes between neighbouring
// angles, elongations, fold limit and fold angles, by their gradients (PathGradients), within a box
// that shrinks where these were wrong (sequential linear programming with a trust region). Ternary
// shifts: a step changes one coordinate or two, in an order by the same gradients. Every sheet is
// folded, and taken only if it is feasible and better.
//
// Every number that decides on a goal of rigid panels comes from additions, products, quotients and
// roots: the same sheets at the same steps, to the last bit, on every processor.
#pragma once

#include "solver/optimise/optimise_options.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

/// Optimises from `start`. Faults: those of the angles in deploy(); amplitude_mm where the shifts
/// of the start are larger or not ternary, or there are none; grid_mm where they do not lie on it;
/// deploys_from_deg, stroke_limit, largest_force_n and floors where the start violates them; goal
/// where it has no value. Reasons: overconstrained, path_lost.
StudyResult<Optimised> optimise(const Sheet& start, const OptimiseOptions& options);

/// The state before the first step: options that fit the sheet, and the value of the goal.
StudyResult<Optimised> fitted_start(const Sheet& start, const OptimiseOptions& options);

}  // namespace misalign::solver
