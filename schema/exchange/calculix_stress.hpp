// Reads stresses from CalculiX's results (calculix_deck.hpp).
#pragma once

#include <iosfwd>
#include <limits>
#include <string>

#include "schema/exchange/panel_mesh.hpp"
#include "schema/exchange/simulated_sheet.hpp"
#include "solver/motion/stress.hpp"

namespace misalign::schema {

struct StressOptions {
  /// Radius of the discs round corners whose stresses are left out: at point forces the stress
  /// diverges as the mesh is refined. A tenth of the paper's panels.
  double disc_mm = 8;
  double until_s = std::numeric_limits<double>::infinity();  ///< later frames are ignored
};

/// Reads a .frd file, without a last frame that is cut off. UserError (failure) if the file is no
/// result of such a deck.
solver::StressHistory read_stresses(std::istream& file, const std::string& name,
                                    const SimulatedSheet& sheet, const PanelMesh& mesh,
                                    const StressOptions& options);

}  // namespace misalign::schema
