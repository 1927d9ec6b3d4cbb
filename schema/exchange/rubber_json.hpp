// Writes the rubber plates of a sheet along its path as JSON.
#pragma once

#include "schema/pattern/pattern_json.hpp"
#include "solver/fitting/cut_outs.hpp"
#include "solver/motion/rubber.hpp"

namespace misalign::schema {

/// "both", "one" (wrinkled across it) or "none": the directions in which a plate is tense.
const char* tension_name(solver::Tension tension);

/// {"shear_mpa", ..., "equivalent_n_per_mm", "pilot_deg", "plates": [{"hole", "corners", "stretch",
/// "edges", "history"}, ...]}; rows of a history are those of pilot_deg, flat first.
Json rubber_json(const Pattern& base, const solver::RubberStudy& study);

/// {"least_n_mm_per_rad2", "pilot_deg"}: the least drive of chosen cut-outs, which stand in "fill".
Json choice_json(const solver::CutOutChoice& choice);

}  // namespace misalign::schema
