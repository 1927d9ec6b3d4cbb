// The goal of an optimisation whose springs are chosen for each sheet: the friction that the best
// springs overcome at every angle.
#pragma once

#include <optional>

#include "solver/fitting/spring_choice.hpp"
#include "solver/optimise/local_goals.hpp"

namespace misalign::solver {

/// Limits of the choice: rates up to that of the given springs, which are plain ones, from the
/// angle of use down to an angle.
SpringChoiceOptions choice_of(const ReleaseOptions& deploying, double to_deg);

/// Static friction of the best springs with panels rigid, N mm per mm; none where no springs drive
/// the sheet.
std::optional<double> chosen_friction_n_mm_per_mm(const Sheet& sheet,
                                                  const OptimiseOptions& options);
/// The friction at each place that limits the springs, which are held as they are chosen, free
/// lengths in proportion to flat ones: the gradient of the best friction is the sum of these by the
/// places' weights (the envelope theorem). Gradients of the creases' turning, some hundredths of
/// the others, are left out.
std::vector<GoalTerm> local_chosen_friction(SheetChanges& changes);

}  // namespace misalign::solver
