#include "solver/certificate/energy_check.hpp"

#include <cassert>

namespace misalign::solver {
namespace {

CheckModel undefined() {
  CheckModel f;
  arb_indeterminate(f[0]);
  return f;
}

// Root of a function by arb's series g of its middle: f - g^2 = (sqrt(f) - g) (sqrt(f) + g).
CheckModel root_of(const CheckModel& f) {
  CheckModel g, middle;
  for (int k = 0; k <= kCheckDegree; ++k) arb_get_mid_arb(middle[k], f[k]);
  _arb_poly_sqrt_series(g[0], middle[0], kCheckDegree + 1, kCheckDegree + 1, kArbBits);
  if (is_positive(f) != Proof::holds) return undefined();
  ArbNumber least, first;
  arb_set(first[0], g[0]);
  least = first + first;
  least = least - most_of(g);
  if (!(ArbNumber(0.0) < least)) return undefined();
  ArbBound off;
  arb_get_mag(off.get(), (most_of(f - g * g) / least)[0]);
  g.widen(off);
  return g;
}

}  // namespace

EnergyCheck::EnergyCheck(const Mechanism& mechanism, const IntervalProver& prover, const Fill& fill)
    : claim_(mechanism, fill), width_mm_(mechanism.panel_width_mm) {
  for (std::size_t d = 0; d < mechanism.diagonals.size(); ++d) {
    const auto a = prover.flat_diagonal(mechanism.diagonals[d]);
    squares_.push_back(a[0] * a[0] + a[1] * a[1]);
    if (d % 2 == 0) continue;
    const auto b = prover.flat_diagonal(mechanism.diagonals[d - 1]);
    products_.push_back(a[0] * b[0] + a[1] * b[1]);
  }
}

void EnergyCheck::find_sides(const std::vector<CheckModel>& slopes) {
  for (const CheckModel& slope : slopes) {
    const ArbNumber flat = value_at(slope, ArbNumber(-1.0)), zero(0.0);
    sides_.push_back(zero < flat ? 1 : flat < zero ? -1 : 0);
  }
}

CheckModel EnergyCheck::slope(const ProvenInterval& interval,
                              const ProvenInterval::Subinterval& subinterval) {
  assert(!sides_.empty() || interval.interval.from_deg == 0);
  if (sides_.empty()) find_sides(subinterval.slopes);
  CheckModel sigma(1.0);
  if (interval.interval.graded) {
    const ArbNumber width(interval.width);
    const ArbNumber middle = ArbNumber(interval.sigma) + width * ArbNumber(subinterval.middle);
    const ArbNumber half = width * ArbNumber(subinterval.half);
    arb_set(sigma[0], middle[0]);
    arb_set(sigma[1], half[0]);
  }
  CheckModel sum;
  for (std::size_t d = 0; d < claim_.springs.size(); ++d) {
    if (claim_.springs[d].rate_n_per_mm == 0) continue;
    sum += spring_slope(d, sigma, subinterval.stretches[d], subinterval.slopes[d]);
  }
  for (std::size_t h = 0; h < claim_.plates.size(); ++h) {
    sum += plate_slope(h, sigma, subinterval);
  }
  return sum;
}

// Twice its slope, k (1 - L0 / L) (L^2)' with 1 - L0 / L = u / (L^2 + L L0), and the free length F
// for L0 where there is a preload: 1 - F / L.
CheckModel EnergyCheck::spring_slope(std::size_t diagonal, const CheckModel& sigma,
                                     const CheckModel& stretch, const CheckModel& slope) const {
  const ClaimedSpring& spring = claim_.springs[diagonal];
  const CheckModel square = CheckModel(squares_[diagonal]) + sigma * stretch;
  const CheckModel length = root_of(square);
  const ArbNumber flat = solver::root_of(squares_[diagonal]);
  const ArbNumber stiffness = ArbNumber(spring.rate_n_per_mm) * width_mm_;
  const CheckModel by_slope = scaled(stiffness, slope);
  if (claim_.is_relaxed_flat()) {
    return by_slope * stretch * reciprocal(square + scaled(flat, length));
  }
  ArbNumber free = flat;
  if (spring.free_mm) {
    free = ArbNumber(*spring.free_mm) / width_mm_;
  } else if (spring.preload_n != 0) {
    if (sides_[diagonal] == 0) return undefined();
    free = flat - ArbNumber(sides_[diagonal] * spring.preload_n) / stiffness;
  }
  return by_slope * (CheckModel(1.0) - scaled(free, reciprocal(length)));
}

// Four times its slope over G t, in Gram matrices M of the hole and M0 of its cut-out:
// det(M0)^(1/2) (tr(M0^-1 M') - tr(M^-1 M') det(M0) / det(M)).
CheckModel EnergyCheck::plate_slope(std::size_t hole, const CheckModel& sigma,
                                    const ProvenInterval::Subinterval& subinterval) const {
  const std::size_t i = 2 * hole, k = i + 1;
  const ClaimedPlate& plate = claim_.plates[hole];
  const ArbNumber p(plate.of_flat[0]), q(plate.of_flat[1]);
  const ArbNumber rest_a = p * p * squares_[i], rest_b = q * q * squares_[k];
  const ArbNumber rest_c = p * q * products_[hole];
  const ArbNumber rest = rest_a * rest_b - rest_c * rest_c, over = ArbNumber(1.0) / rest;
  const CheckModel a = CheckModel(squares_[i]) + sigma * subinterval.stretches[i];
  const CheckModel b = CheckModel(squares_[k]) + sigma * subinterval.stretches[k];
  const CheckModel det = a * b - CheckModel(products_[hole] * products_[hole]);
  const CheckModel trace = scaled(over * rest_b, a) + scaled(over * rest_a, b) -
                           CheckModel(over * (rest_c * products_[hole] + rest_c * products_[hole]));
  // l2^2 l1 > 1 where J^4 is beyond the larger root l1^2 of x^2 - x tr + J^2.
  const CheckModel j2 = scaled(over, det), j4 = j2 * j2;
  if (is_positive(j4 + j4 - trace) != Proof::holds ||
      is_positive(j4 * (j4 - trace) + j2) != Proof::holds) {
    return undefined();
  }
  const CheckModel &a_rate = subinterval.slopes[i], &b_rate = subinterval.slopes[k];
  const CheckModel pull = scaled(over * rest_b, a_rate) + scaled(over * rest_a, b_rate);
  const CheckModel swell = (a_rate * b + a * b_rate) * reciprocal(det) * reciprocal(j2);
  return scaled(ArbNumber(plate.shear_n_per_mm) * solver::root_of(rest), pull - swell);
}

}  // namespace misalign::solver
