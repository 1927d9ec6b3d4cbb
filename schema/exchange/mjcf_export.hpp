// Writes a model for MuJoCo (MJCF, tried with 2.2) of a deploying sheet.
#pragma once

#include <string>

#include "schema/exchange/simulated_sheet.hpp"

namespace misalign::schema {

struct MjcfOptions {
  /// Dry friction of creases, N mm/mm. It acts only on creases in the joint tree: MuJoCo has none
  /// for `connect`, and ball joints have none.
  double friction_n_mm_per_mm = 0;
  /// Largest time step of the integrator; small or stiff sheets take shorter ones. Loops close like
  /// a spring-damper with a time constant of two steps: half the step leaves a quarter of the gap
  /// (Table 1 from 36 degrees: 7e-5 mm).
  double time_step_s = 5e-5;
};

/// Bodies are panels, whose frames are the world's at the start: places in the file are those of
/// the folded sheet. A tree of hinges (named by their creases; their values are fold angles, rad,
/// valleys positive) and ball joints has a free root; other joints are `connect`, springs spatial
/// tendons. Masses and inertias are those of plates, solver::panel_masses. Panels have no contact.
/// Units are mm, t and s, or finer ones where MuJoCo refuses such small moments of inertia.
std::string mjcf_model(const SimulatedSheet& sheet, const MjcfOptions& options);

}  // namespace misalign::schema
