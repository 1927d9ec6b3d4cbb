// A deployment as people type it: panels and diagonals by their names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "search/sheets/folding_model.hpp"
#include "solver/bending/bent_panels.hpp"

namespace misalign::search {

struct DeployInput {
  solver::ReleaseOptions options;  ///< all but the members below
  schema::Design design;           ///< overrides the file's
  std::optional<double> density_g_per_cm3;
  std::vector<std::string> other_rests;  ///< "A11-A17=60"
  std::optional<std::string> held;       ///< "0,0": row and column of a panel
  std::vector<double> gravity;           ///< x, y, z in standard gravities, or none

  /// The options merged with the file's design. UserError (bad_request) for unknown panels or
  /// diagonals.
  solver::ReleaseOptions of(const solver::Sheet& sheet, const schema::Design& of_file) const;
};

/// Returns the number of a diagonal named "A3-A9"; -1 if there is none.
int diagonal_of_label(const solver::Mechanism& mechanism, const std::string& label);

/// The dry friction of a sheet's creases: the design's, or the mean loss of their films from the
/// angle of release.
double hinge_friction_n_mm_per_mm(const schema::Design& design, const solver::Sheet& sheet);

/// The options of a sheet's release by its design; `options` hold what no design says.
/// UserError (bad_request) where it has no such panel to hold.
solver::ReleaseOptions deploy_options(const schema::Design& design, const solver::Sheet& sheet,
                                      solver::ReleaseOptions options = {});

/// The design's options of bending: its material, otherwise aluminium.
solver::BentPanelsOptions bending(const schema::Design& design);

/// Returns whether panels bend by default: a material is named, and springs end on the vertices.
inline bool panels_bend(const schema::Design& design, const solver::Sheet& sheet) {
  return design.material && sheet.base().springs.at_vertices();
}

}  // namespace misalign::search
