// Stretches, wrinkles and forces of the rubber plates in a sheet's holes along its path.
//
// Creep, and the rate at which rubber is stretched, are left out.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/fill/hole_energy.hpp"
#include "solver/sheet/sheet_filling.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

struct RubberOptions {
  RubberPlates plates;
  std::optional<double> from_deg = {};  ///< angle of use, a station of the history; none: D
};

/// One plate at one angle.
struct PlateState {
  PlateLaw::Stretches stretches;
  /// Mean forces on its edges, over their lengths; edge k begins at corner k of the plate.
  std::array<double, 4> edge_n_per_mm;
};

/// One hole's plate along the way.
struct PlateWay {
  int facet;                   ///< facet of the hole
  std::array<int, 4> corners;  ///< vertices: the first diagonal leads from 0 to 2, the other 1 to 3
  std::vector<PlateState> states;  ///< a row each
  struct Largest {
    double value, pilot_deg;
  };
  Largest stretch, edge_n_per_mm;
};

/// Row 0 is the flat sheet, row i + 1 the i-th of the history, up to the angle of use.
struct RubberStudy {
  RubberOptions options;
  std::vector<double> pilot_deg;
  std::vector<PlateWay> plates;
  /// Rate of springs on both diagonals that are worth an unstretched plate: 0.95 G t, measured on
  /// Table 1 at 36 degrees (results/rubber.md).
  double equivalent_n_per_mm;
};

/// Obstacles: an angle of use beyond D; a lost path where the plates are relaxed in a folded state.
StudyResult<RubberStudy> study_rubber(const Sheet& sheet, const RubberOptions& options);

}  // namespace misalign::solver
