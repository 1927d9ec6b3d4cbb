// An input deck for CalculiX (ccx, tried with 2.20) of a sheet about to deploy: elastic panels in
// motion.
#pragma once

#include <string>

#include "schema/exchange/panel_mesh.hpp"
#include "schema/exchange/simulated_sheet.hpp"
#include "schema/pattern/material.hpp"

namespace misalign::schema {

struct DeckOptions {
  int elements = 2;  ///< a panel's side is cut in so many
  Material material;
  double end_s = 1;
  /// Of the implicit integrator, which shortens it where it must: about a fifth of the period of a
  /// panel of the paper's that bends (2 ms).
  double time_step_s = 4e-4;
  /// Against the velocity of all mass, per unit of both: free flight slows down like
  /// exp(-damping t).
  double damping_per_s = 0;
};

/// Eight-node shells (S8R) of panels with nodes of their own; where panels meet, nodes are tied by
/// equations of their translations: a crease turns freely. Of k panels at a corner k - 1 are tied
/// to the first, in each direction. Springs (SPRINGA) are non-linear ones, which may pull from the
/// start on: F = k (L - L0). Free in space, at rest, no damping but the integrator's where
/// none is asked for. ccx writes where corners are, energies and stresses at each increment.
std::string calculix_deck(const SimulatedSheet& sheet, const DeckOptions& options);

/// Node sets and element sets of the deck.
inline constexpr const char* kCornerSet = "CORNERS";
inline constexpr const char* kPanelSet = "PANELS";

}  // namespace misalign::schema
