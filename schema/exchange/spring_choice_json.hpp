// Writes chosen springs as JSON.
#pragma once

#include "schema/files/input.hpp"
#include "solver/fitting/spring_choice.hpp"

namespace misalign::schema {

/// The friction that they overcome, its bounds, the effort, the places that limit them ("rows",
/// with the lengths of all diagonals), and "fill" as a design takes it, null where no springs drive
/// the sheet.
Json spring_choice_json(const solver::PerforatedSheet& base, const solver::Mechanism& mechanism,
                        const solver::SpringChoice& choice);

}  // namespace misalign::schema
