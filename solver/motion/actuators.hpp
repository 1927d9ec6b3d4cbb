// The filling of a sheet's holes as the actuators of its deployment.
#pragma once

#include <optional>

#include "solver/fill/fill.hpp"

namespace misalign::solver {

/// A filling and the stroke that its parts allow.
struct Actuators {
  Fill fill = Springs{};
  std::optional<double> stroke_limit;  ///< largest |L - L0| / L0; 0.08 for the paper's Ti-Ni wires
  /// Diagonals whose springs touch: the smallest set never has both of a pair.
  std::vector<std::pair<int, int>> never_both = {};

  /// The filling must be springs.
  const Springs& springs() const { return std::get<Springs>(fill); }
  Springs& springs() { return std::get<Springs>(fill); }
};

}  // namespace misalign::solver
