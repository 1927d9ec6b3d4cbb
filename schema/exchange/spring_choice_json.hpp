// Writes chosen springs as JSON.
#pragma once

#include "schema/files/input.hpp"
#include "solver/optimise/spring_choice.hpp"

namespace misalign::schema {

/// A filling with these springs, as "fill" of a design takes it; null where none drive the sheet.
Json chosen_fill_json(const solver::Mechanism& mechanism, const solver::SpringChoice& choice);

/// The friction that they overcome, its bounds, each spring, the filling, the effort, and the
/// places that limit them ("rows", with the lengths of all diagonals).
Json spring_choice_json(const solver::Mechanism& mechanism, const solver::SpringChoice& choice);

}  // namespace misalign::schema
