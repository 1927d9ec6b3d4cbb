// Springs or wires on the diagonals of the holes: which.
#pragma once

#include <optional>

namespace misalign::solver {

/// One on every diagonal, relaxed on the flat sheet but for its preload.
struct Actuators {
  double stiffness_n_per_mm = 50;      ///< the paper's springs
  std::optional<double> stroke_limit;  ///< largest |L - L0| / L0; 0.08 for the paper's Ti-Ni wires
  /// What each is left with at flat: those on diagonals that lengthen as the sheet folds pull,
  /// those on diagonals that shorten push.
  double preload_n = 0;
};

}  // namespace misalign::solver
