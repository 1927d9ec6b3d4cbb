// The checker's slope of the total energy of what fills the holes, by arb's models. It shares the
// filling's numbers with energy_slope.hpp, and no formula.
#pragma once

#include <vector>

#include "solver/certificate/energy_claim.hpp"
#include "solver/certificate/proven_interval.hpp"

namespace misalign::solver {

class EnergyCheck {
 public:
  /// `mechanism` and `prover` must outlive this object; `fill` must be certifiable.
  EnergyCheck(const Mechanism& mechanism, const IntervalProver& prover, const Fill& fill);

  /// dE/ds all over a subinterval, times a positive function; undefined where a plate is not proven
  /// to be tense. The first subinterval must begin at flat.
  CheckModel slope(const ProvenInterval& interval, const ProvenInterval::Subinterval& subinterval);

 private:
  void find_sides(const std::vector<CheckModel>& slopes);
  CheckModel spring_slope(std::size_t diagonal, const CheckModel& sigma, const CheckModel& stretch,
                          const CheckModel& slope) const;
  CheckModel plate_slope(std::size_t hole, const CheckModel& sigma,
                         const ProvenInterval::Subinterval& subinterval) const;

  const EnergyClaim claim_;
  const ArbNumber width_mm_;
  std::vector<ArbNumber> squares_, products_;  // of flat diagonals, panel widths squared
  std::vector<int> sides_;                     // 1 longer next to flat, -1 shorter, 0 not known
};

}  // namespace misalign::solver
