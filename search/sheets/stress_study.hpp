// The deployment of a sheet of elastic panels, by CalculiX: whether it deploys, and the stresses in
// its panels.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "schema/exchange/calculix_deck.hpp"
#include "schema/exchange/calculix_result.hpp"
#include "search/sheets/calculix_run.hpp"
#include "solver/design/deployment.hpp"

namespace misalign::search {

struct StressStudyOptions {
  schema::DeckOptions deck;
  schema::StressOptions stress;
  /// Deployed when every crease is as close to flat as this at one moment; there the run ends. 0:
  /// only at the end of time.
  double flat_deg = 5;
};

struct StressStudy {
  std::vector<schema::ElasticRow> rows;  ///< up to the deployed one
  schema::StressHistory stress;
  std::optional<double> deployed_s;
  bool was_stopped = false;  ///< by whom it was shown to
  /// Whether ccx gave up before the end of time, or wrote what is no number: a numerical failure.
  bool gave_up = false;
  CalculixEnd calculix;
  /// Of the same sheet with rigid panels, from the same start until it is flat or turns round.
  std::vector<solver::DeploymentRow> rigid;

  /// The rigid motion's pilot angle; none after its end.
  std::optional<double> rigid_pilot_deg(double time_s) const;
};

/// Runs ccx in a fresh directory inside of this one, whose files come here in the end, and reads
/// what it found. `goes_on` gets the last row now and then, and ends the run by false: what was
/// found until then is the result. UserError (1): no ccx, nothing can be written, or ccx found
/// nothing at all.
StressStudy study_stress(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                         const std::string& directory, const std::string& job,
                         const std::function<bool(const schema::ElasticRow&)>& goes_on);

/// The contract's `stress --json`, without whose it is.
schema::Json stress_json(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                         const StressStudy& study);

}  // namespace misalign::search
