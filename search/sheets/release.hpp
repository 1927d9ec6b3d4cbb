// A sheet folded to the angle of its release, for programs that simulate its deployment.
#pragma once

#include <optional>

#include "schema/exchange/simulated_sheet.hpp"
#include "search/sheets/deployer.hpp"
#include "search/sheets/folded_sheet.hpp"

namespace misalign::search {

struct ReleaseOptions {
  /// The angle of release: kDeployFrom_deg, or D if that is less.
  std::optional<double> from_deg;
  /// The pilot angle at which the springs are relaxed.
  double rest_deg = 0;
  solver::Plates plates;
};

/// `folded` is of this folder; `title` stands in files, `name` in sentences. UserError: 2 if the
/// sheet has no such folded states, or no start is named for one that deploys from nothing; 6 as
/// SheetFolder::check_shapes.
schema::SimulatedSheet release(const SheetFolder& folder, const FoldedSheet& folded,
                               const ReleaseOptions& options, const std::string& title,
                               const std::string& name);

}  // namespace misalign::search
