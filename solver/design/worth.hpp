// What a sheet is worth to an optimisation, where it keeps what is asked.
#pragma once

#include <optional>

#include "solver/design/optimise.hpp"

namespace misalign::solver {

/// `options.deploying` says from where it is let go.
bool is_strong_enough(const Sheet& sheet, const OptimiseOptions& options);
/// Whether it deploys from the angle that is asked, can be let go there, and keeps both limits.
bool fits(const Sheet& sheet, const OptimiseOptions& options);
/// By the goal; none where it does not fit, or its own study finds none.
std::optional<double> worth(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
