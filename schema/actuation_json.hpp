// Springs on the diagonals, as JSON.
#pragma once

#include "schema/folding_json.hpp"
#include "solver/actuation.hpp"

namespace misalign::schema {

/// "A11-A17"
std::string diagonal_label(const solver::Mechanism& mechanism, int diagonal);

/// What a candidate's file says of them: actuators, force on each diagonal at D, weakest point, the
/// few that would do, where the stroke ends.
Json actuation_json(const FoldingView& view, const solver::ShapedPath& path,
                    const solver::Actuation& actuation);

/// That, and "history": energy, moment, mechanical advantage and forces, flat first.
Json actuation_history_json(const FoldingView& view, const solver::ShapedPath& path,
                            const solver::Actuation& actuation);

/// A list; null for what is no number.
Json numbers_json(const std::vector<double>& numbers);

}  // namespace misalign::schema
