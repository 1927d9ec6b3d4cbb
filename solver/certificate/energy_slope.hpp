// The slope of the total energy of what fills the holes, all over a tube, by Taylor models.
//
// A diagonal's squared length L^2 differs by u from the flat sheet's L0^2. A spring of rate k and
// preload p has dE/ds = (k (L - L0) + p) L' = (k u / (L + L0) + p) u' / (2 L). Graded, u is sigma
// g: the slope of springs that are relaxed flat is divided by sigma, and is regular at flat. The
// energy of a plate that is tense in both directions (hole_energy.hpp) is rational in the squares
// of the diagonals. All of this also holds for complex s with |s| < 1, since models are bounded by
// the sizes of their coefficients (README.md, "Wells").
#pragma once

#include <vector>

#include "solver/certificate/energy_claim.hpp"
#include "solver/certificate/tube_prover.hpp"

namespace misalign::solver {

/// The total energy all over a tube, and its derivative by s times a positive constant, over sigma
/// too where all springs are relaxed flat. Radii are infinite where a plate is not proven to be
/// tense.
struct EnergyAlong {
  PathModel n_mm, slope;
};

class EnergySlope {
 public:
  /// `mechanism` must outlive this object; `fill` must be certifiable. `flat` has the squares of
  /// the diagonals' lengths and the products of the holes', from TubeProver::flat_diagonals.
  EnergySlope(const Mechanism& mechanism, const Fill& fill, FlatDiagonals flat);

  /// Takes the directions in which preloads act from the first tube.
  void begin(const std::vector<PathModel>& slopes);

  EnergyAlong along(const PathTube& tube, const DiagonalsAlong& diagonals) const;

 private:
  EnergyAlong of_spring(std::size_t diagonal, const PathModel& sigma, const PathModel& stretch,
                        const PathModel& slope) const;
  EnergyAlong of_plate(std::size_t hole, const PathModel& sigma,
                       const DiagonalsAlong& diagonals) const;

  const EnergyClaim claim_;
  const FlatDiagonals flat_;
  const double width_mm_;
  const bool is_relaxed_flat_;
  std::vector<int> sides_;
};

}  // namespace misalign::solver
