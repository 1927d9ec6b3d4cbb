// A deployment as people type it: panels and diagonals by their names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "search/sheets/folding_model.hpp"
#include "solver/bending/bent_panels.hpp"

namespace misalign::search {

struct DeployInput {
  solver::ReleaseOptions options;  ///< but for what follows
  schema::Design design;           ///< what is said goes before the file's
  std::optional<double> density_g_per_cm3;
  std::vector<std::string> other_rests;  ///< "A11-A17=60"
  std::optional<std::string> held;       ///< "0,0": row and column of a panel
  std::vector<double> gravity;           ///< x, y, z in standard gravities, or none

  /// With the file's design. UserError (bad_request) where they do not fit its panels or diagonals.
  solver::ReleaseOptions of(const solver::Sheet& sheet, const schema::Design& of_file) const;
};

/// The dry friction of a sheet's creases, as the design says it or as their films lose it from
/// where it is let go.
double hinge_friction_n_mm_per_mm(const schema::Design& design, const solver::Sheet& sheet);

/// The options with which a sheet of this design is let go; `options` hold what no design says.
/// UserError (bad_request) where it has no such panel to hold.
solver::ReleaseOptions deploy_options(const schema::Design& design, const solver::Sheet& sheet,
                                      solver::ReleaseOptions options = {});

/// How panels of this design bend: of its material, otherwise aluminium.
solver::BentPanelsOptions bending(const schema::Design& design);

/// Whether panels bend where nothing is said: a material is named, and springs end on the vertices.
inline bool panels_bend(const schema::Design& design, const solver::Sheet& sheet) {
  return design.material && sheet.base().springs.at_vertices();
}

}  // namespace misalign::search
