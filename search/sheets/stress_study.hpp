// Runs the study of stress: writes the deck, watches CalculiX, reads the results.
#pragma once

#include <functional>
#include <string>

#include "schema/exchange/calculix_deck.hpp"
#include "schema/exchange/calculix_stress.hpp"

namespace misalign::search {

struct StressStudyOptions {
  schema::DeckOptions deck;
  schema::StressOptions stress;
  /// The run ends when every crease is as close to flat as this at one moment; 0: at the end of
  /// time.
  double flat_deg = 5;
};

/// Runs ccx in a fresh directory inside this one, moves its files here at the end, and reads the
/// results. `goes_on` gets the last row now and then, and ends the run by false: the results so far
/// are returned. UserError (failure): no ccx, nothing can be written, or no increment was made.
solver::StressStudy study_stress(
    const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
    const std::string& directory, const std::string& job,
    const std::function<bool(const solver::StressStudy::Row&)>& goes_on);

}  // namespace misalign::search
