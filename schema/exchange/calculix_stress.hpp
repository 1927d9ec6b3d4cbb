// Reads stresses of CalculiX's results of a deck (calculix_deck.hpp).
#pragma once

#include <iosfwd>
#include <limits>
#include <string>

#include "schema/exchange/panel_mesh.hpp"
#include "schema/exchange/simulated_sheet.hpp"
#include "solver/motion/stress.hpp"

namespace misalign::schema {

struct StressOptions {
  /// Radius of the discs round the corners of each panel: forces that act at a point have no limit
  /// there as meshes get finer. A tenth of the paper's panels.
  double disc_mm = 8;
  double until_s = std::numeric_limits<double>::infinity();  ///< later frames do not count
};

/// Reads a .frd file; its last frame may be cut off, and then does not count. UserError (failure)
/// if the file is not what ccx writes of such a deck.
solver::StressHistory read_stresses(std::istream& file, const std::string& name,
                                    const SimulatedSheet& sheet, const PanelMesh& mesh,
                                    const StressOptions& options);

}  // namespace misalign::schema
