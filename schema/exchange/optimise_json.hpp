// A sheet that was made better, as JSON: its pattern, the value of its goal, and what limits it.
#pragma once

#include "schema/campaign/optimise_bounds.hpp"
#include "schema/exchange/folding_json.hpp"
#include "solver/optimise/optimise.hpp"

namespace misalign::schema {

/// As keys and columns have it.
const char* name_of(solver::Optimised::StopReason reason);

/// What limits an end: by how much the goal would grow with more room, and diagonals that would
/// turn back.
Json limits_json(const solver::Mechanism& mechanism, const solver::OptimiseOptions& options,
                 const solver::Optimised::Limits& limits);

/// `sheet`: the one that was found, proven up to `certified_deg`, and its pattern file.
Json optimise_json(const solver::Sheet& sheet, const solver::Optimised& found,
                   std::optional<double> certified_deg, const Json& pattern);

}  // namespace misalign::schema
