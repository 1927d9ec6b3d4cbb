// A model for MuJoCo (MJCF, tried with 2.2) of a sheet about to deploy.
#pragma once

#include <string>

#include "schema/exchange/simulated_sheet.hpp"

namespace misalign::schema {

struct MjcfOptions {
  /// Dry friction in creases, N mm per mm of their length. Only on those that are branches of the
  /// joint tree: MuJoCo has none for `connect`, and none for ball joints is meant.
  double friction_n_mm_per_mm = 0;
  /// Of the integrator, at most; small or stiff sheets take shorter ones. Loops close as a
  /// spring-damper with a time constant of two steps does: half the step, and they are open by a
  /// quarter (Table 1 from 36 degrees: 7e-5 mm).
  double time_step_s = 5e-5;
};

/// Bodies are panels, whose frames are the world's at the start: every place in the file is one of
/// the folded sheet. A tree of hinges (named by their creases; their values are fold angles, rad,
/// valleys positive) and ball joints, the root free; other joints as `connect`; springs as spatial
/// tendons. Masses and inertias are those of plates, solver::panel_masses. Panels do not touch.
/// In mm, t and s, or finer units where MuJoCo refuses such small moments of inertia.
std::string mjcf_model(const SimulatedSheet& sheet, const MjcfOptions& options);

}  // namespace misalign::schema
