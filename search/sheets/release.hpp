// A sheet folded to the angle of its release, for programs that simulate its deployment.
#pragma once

#include <optional>

#include "schema/exchange/simulated_sheet.hpp"
#include "search/sheets/folding_model.hpp"

namespace misalign::search {

struct SimulationStart {
  /// The angle of release: solver::kDeployFrom_deg, or D if that is less.
  std::optional<double> from_deg;
  /// The pilot angle at which the springs are relaxed.
  double rest_deg = 0;
  solver::Plates plates;
};

/// `sheet` is of this model; `title` stands in files. UserError: 2 if the sheet has no such folded
/// states, or no start is named for one that does not deploy; 6 as check_shapes.
schema::SimulatedSheet release(const FoldingModel& model, const solver::Sheet& sheet,
                               const SimulationStart& options, const std::string& title);

}  // namespace misalign::search
