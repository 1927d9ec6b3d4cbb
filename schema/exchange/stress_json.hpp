// Writes a study of stress as JSON.
#pragma once

#include "schema/exchange/calculix_deck.hpp"
#include "solver/motion/stress.hpp"

namespace misalign::schema {

/// The JSON of `stress --json`, without the sheet's name.
Json stress_json(const SimulatedSheet& sheet, const DeckOptions& deck, double disc_mm,
                 const solver::StressStudy& study);

}  // namespace misalign::schema
