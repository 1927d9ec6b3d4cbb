// Reads the numbers of a filling as prover and checker of its energy take them.
#pragma once

#include <optional>
#include <vector>

#include "solver/fill/certifiable.hpp"

namespace misalign::solver {

/// A spring that is relaxed flat, apart from a preload.
struct ClaimedSpring {
  double rate_n_per_mm = 0;
  double preload_n = 0;                ///< pulls if the diagonal lengthens from flat on
  std::optional<double> free_mm = {};  ///< replaces the preload
  bool is_relaxed() const { return preload_n == 0 && !free_mm; }
};

/// A plate of shear modulus times thickness, and the ratios of its cut-out's diagonals to those of
/// the flat hole.
struct ClaimedPlate {
  double shear_n_per_mm = 0;
  std::array<double, 2> of_flat{};
};

/// The filling of every diagonal, or else of every hole.
struct EnergyClaim {
  std::vector<ClaimedSpring> springs;
  std::vector<ClaimedPlate> plates;

  /// `fill` must be certifiable (certifiable.hpp).
  EnergyClaim(const Mechanism& mechanism, const Fill& fill);

  /// True if E grows as rho^4 next to flat: its slope is then divided by sigma.
  bool is_relaxed_flat() const;
};

}  // namespace misalign::solver
