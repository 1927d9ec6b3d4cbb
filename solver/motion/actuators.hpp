// Springs or wires on the diagonals of the holes.
#pragma once

#include <optional>

#include "solver/fill/fill.hpp"

namespace misalign::solver {

/// One spring on every diagonal, relaxed on the flat sheet except for its preload.
struct Actuators {
  double stiffness_n_per_mm = 50;      ///< the paper's springs
  std::optional<double> stroke_limit;  ///< largest |L - L0| / L0; 0.08 for the paper's Ti-Ni wires
  Preload preload = {};
};

}  // namespace misalign::solver
