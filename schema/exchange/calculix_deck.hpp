// Writes an input deck for CalculiX (ccx, tried with 2.20) of a deploying sheet with elastic
// panels.
#pragma once

#include <string>

#include "schema/exchange/panel_mesh.hpp"
#include "schema/exchange/simulated_sheet.hpp"
#include "schema/pattern/material.hpp"

namespace misalign::schema {

struct DeckOptions {
  int elements = 2;  ///< number of elements along a panel's side
  Material material;
  double end_s = 1;
  /// First time step of the implicit integrator, which shortens it: about a fifth of the bending
  /// period of a panel of the paper (2 ms).
  double time_step_s = 4e-4;
  /// Damping force per mass and velocity: free flight slows down like exp(-damping t).
  double damping_per_s = 0;
};

/// The deck: eight-node shells (S8R), a mesh for each panel. Equations tie the translations of
/// nodes that panels share, so that creases turn freely: of k panels at a corner k - 1 are tied to
/// the first, in each direction. Non-linear springs (SPRINGA) may pull at the start: F = k (L -
/// L0). The sheet is free in space and starts at rest; without `damping_per_s` only the integrator
/// damps. ccx writes corners, energies and stresses at each increment.
std::string calculix_deck(const SimulatedSheet& sheet, const DeckOptions& options);

/// Node sets and element sets of the deck.
inline constexpr const char* kCornerSet = "CORNERS";
inline constexpr const char* kPanelSet = "PANELS";

}  // namespace misalign::schema
