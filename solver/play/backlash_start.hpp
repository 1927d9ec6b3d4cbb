// Finds the start of all trials of a sheet with play: the state without play half way between
// from_deg and the angle of use, and the stations from there up and down.
#pragma once

#include <optional>
#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/fill/filling.hpp"
#include "solver/model/model.hpp"

namespace misalign::solver {

struct BacklashOptions {
  /// Angle of use, the largest pilot angle that counts; none: D.
  std::optional<double> used_from_deg{};
  /// Least pilot angle that counts. Below, springs that are relaxed when flat
  /// hardly pull: their moment falls with the cube of the angle, to 1/370 of that at 36 degrees.
  double from_deg = 5;
  /// The step between the angles below `from_deg` at which the assignment is checked.
  double flat_step_deg = 0.1;
};

/// The sheet without play, with which trials start and are compared.
struct BacklashStart {
  SheetGeometry<double> geometry;
  double own_deg = 0;  ///< D
  /// The first sample from the angle of use on, at most D; all below needs it above from_deg.
  int to_sample = 0;
  double to_deg = 0;
  double start_deg = 0;         ///< a sample, about half way from from_deg to to_deg
  FoldState<double> start;      ///< state at start_deg
  std::vector<int> directions;  ///< one per diagonal, from from_deg to to_deg: +1 lengthens
  double shortest_crease_widths = 0;
  std::optional<Filling> filling;  ///< made for it; trials look for their stops if it is given
};

/// Follows the path of the sheet without play.
BacklashStart prepare_backlash(const Model& model, const FlatVertices& vertices_mm,
                               const BacklashOptions& options);

/// Plans samples from the start up to the angle of use.
PathPlan plan_up(const BacklashStart& sheet, double sample_deg);
/// Plans samples from the start down to `from_deg` and to flat, as angles below the start.
PathPlan plan_down(const BacklashStart& sheet, double sample_deg, const BacklashOptions& options);

}  // namespace misalign::solver
