// Writes an optimised sheet as JSON: its pattern, its objective, and its active constraints.
#pragma once

#include "schema/campaign/optimise_bounds.hpp"
#include "schema/exchange/folding_json.hpp"
#include "solver/optimise/optimise.hpp"

namespace misalign::schema {

/// The reason's name in keys and columns.
const char* name_of(solver::Optimised::StopReason reason);

/// The constraints that limit an optimum: gains of the objective where they are relaxed, and
/// diagonals that would reverse.
Json limits_json(const solver::Mechanism& mechanism, const solver::OptimiseOptions& options,
                 const solver::Optimised::Limits& limits);

/// `sheet`: the optimum, proven up to `certified_deg`; `pattern`: its pattern file.
Json optimise_json(const solver::Sheet& sheet, const solver::Optimised& found,
                   std::optional<double> certified_deg, const Json& pattern);

}  // namespace misalign::schema
