// Runs the study of stress: writes the deck, watches CalculiX, reads what it found.
#pragma once

#include <functional>
#include <string>

#include "schema/exchange/calculix_deck.hpp"
#include "schema/exchange/calculix_stress.hpp"

namespace misalign::search {

struct StressStudyOptions {
  schema::DeckOptions deck;
  schema::StressOptions stress;
  /// Deployed when every crease is as close to flat as this at one moment; there the run ends. 0:
  /// only at the end of time.
  double flat_deg = 5;
};

/// Runs ccx in a fresh directory inside of this one, whose files come here in the end, and reads
/// what it found. `goes_on` gets the last row now and then, and ends the run by false: what was
/// found until then is the result. UserError (failure): no ccx, nothing can be written, or ccx
/// found nothing at all.
solver::StressStudy study_stress(
    const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
    const std::string& directory, const std::string& job,
    const std::function<bool(const solver::StressStudy::Row&)>& goes_on);

}  // namespace misalign::search
