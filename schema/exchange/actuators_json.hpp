// Writes the filling of the holes and its forces on the diagonals as JSON.
#pragma once

#include "schema/exchange/folding_json.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::schema {

/// "A11-A17"
std::string diagonal_label(const std::vector<solver::Diagonal>& diagonals, int diagonal);
std::string diagonal_label(const solver::Mechanism& mechanism, int diagonal);
/// "A11-A17, A3-A9"; "none".
std::string diagonal_labels(const solver::Mechanism& mechanism, const std::vector<int>& diagonals);

/// [["A11-A17", "A10-A16"], ...].
Json pairs_json(const solver::Mechanism& mechanism, const std::vector<std::pair<int, int>>& pairs);

/// Adds the filling to an object about it as "fill"; of springs also their rate, and what else they
/// have, by the keys that they had before there were other fillings.
void add_filling(const solver::Fill& fill, const solver::PerforatedSheet& base, Json& json);

/// Springs of a candidate's file: actuators, force on each diagonal at D, weakest point, fewest
/// springs, stroke limit.
Json actuation_json(const FoldingView& view, const solver::Actuation& actuation);

/// actuation_json and "history": energy, moment, mechanical advantage and forces, flat first.
Json actuation_history_json(const FoldingView& view, const solver::Actuation& actuation);

/// weakest, few and over_stroke, null where there is none; diagonals by their number, from 0.
Json limits_json(const solver::Actuation& actuation);

}  // namespace misalign::schema
