// A deployment as people type it: panels and diagonals by their names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "search/sheets/folding_model.hpp"
#include "solver/design/bent_panels.hpp"

namespace misalign::search {

struct DeployInput {
  solver::DeployOptions options;             ///< but for what follows
  std::optional<double> stiffness_n_per_mm;  ///< none: the model's
  std::vector<std::string> other_rests;      ///< "A11-A17=60"
  std::optional<std::string> held;           ///< "0,0": row and column of a panel
  std::vector<double> gravity;               ///< x, y, z in standard gravities, or none

  /// UserError (bad_request) where they do not fit its panels or diagonals.
  solver::DeployOptions of(const solver::Sheet& sheet, const solver::Actuators& actuators) const;
};

/// The sheet let go. UserError: 2 where an option does not fit it, 1 where its path is lost.
solver::DeploymentStudy deployed(const solver::Sheet& sheet, const solver::DeployOptions& options);

/// Its panels bent. UserError as above.
solver::BentPanels bent_panels(const solver::Sheet& sheet, const solver::DeployOptions& deploying,
                               const solver::BentPanelsOptions& options);

}  // namespace misalign::search
