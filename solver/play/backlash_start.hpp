// Finds the start of all trials of a sheet with play: its own state half way between flat and D,
// and the stations from there up and down.
#pragma once

#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/model/model.hpp"

namespace misalign::solver {

struct BacklashOptions {
  /// Pilot angles from here to D count. Below, springs that are relaxed when flat hardly pull:
  /// their moment falls with the cube of the angle, to 1/370 of that at 36 degrees.
  double from_deg = 5;
  /// The step between the angles below `from_deg` at which the assignment is checked.
  double flat_step_deg = 0.1;
};

/// The sheet itself: what its trials start from and are compared with.
struct BacklashStart {
  SheetGeometry<double> geometry;
  int own_sample = 0;  ///< D; what follows is only there if that lies above from_deg
  double own_deg = 0;
  double start_deg = 0;         ///< a sample, about half way between
  FoldState<double> start;      ///< there
  std::vector<int> directions;  ///< of each diagonal from from_deg to D: +1 lengthens
  double shortest_crease_widths = 0;
};

/// Follows the sheet's own path.
BacklashStart prepare_backlash(const Model& model, const FlatVertices& vertices_mm,
                               const BacklashOptions& options);

/// Samples from the start up to D.
PathPlan plan_up(const BacklashStart& sheet, double sample_deg);
/// Samples from the start down to `from_deg`, and on to flat; as angles below the start.
PathPlan plan_down(const BacklashStart& sheet, double sample_deg, const BacklashOptions& options);

}  // namespace misalign::solver
