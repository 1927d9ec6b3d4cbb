// Springs or wires on the diagonals of the holes: which.
#pragma once

#include <optional>

namespace misalign::solver {

/// One on every diagonal, relaxed on the flat sheet.
struct Actuators {
  double stiffness_n_per_mm = 50;      ///< the paper's springs
  std::optional<double> stroke_limit;  ///< largest |L - L0| / L0; 0.08 for the paper's Ti-Ni wires
};

}  // namespace misalign::solver
