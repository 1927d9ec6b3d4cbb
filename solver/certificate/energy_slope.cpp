#include "solver/certificate/energy_slope.hpp"

#include <cassert>
#include <limits>
#include <utility>

#include "solver/certificate/conditions.hpp"

namespace misalign::solver {
namespace {

constexpr double kTenseResolution = 0.01;

EnergyAlong unknown() {
  const PathModel any = PathModel::number(0, std::numeric_limits<double>::infinity());
  return {any, any};
}

bool is_proven_positive(const PathModel& f) { return positive_until(f, kTenseResolution) == 1; }

}  // namespace

EnergySlope::EnergySlope(const Mechanism& mechanism, const Fill& fill, FlatDiagonals flat)
    : claim_(mechanism, fill),
      flat_(std::move(flat)),
      width_mm_(mechanism.panel_width_mm),
      is_relaxed_flat_(claim_.is_relaxed_flat()) {}

void EnergySlope::begin(const std::vector<PathModel>& slopes) {
  sides_.clear();
  for (const PathModel& slope : slopes) {
    const Ball flat = value_at(slope, Ball(-1.0));
    const bool is_known = std::abs(flat.c[0]) > kUp * flat.radius;
    sides_.push_back(is_known ? (flat.c[0] > 0 ? 1 : -1) : 0);
  }
}

EnergyAlong EnergySlope::along(const PathTube& tube, const DiagonalsAlong& diagonals) const {
  const bool graded = tube.chart.is_graded();
  const PathModel sigma =
      graded ? PathModel(tube.chart.sigma()) + tube.chart.half_width() * PathModel::line(0, 1)
             : PathModel(1.0);
  EnergyAlong sum;
  const auto add = [&sum](const EnergyAlong& part) {
    sum.n_mm += part.n_mm;
    sum.slope += part.slope;
  };
  for (std::size_t h = 0; h < claim_.plates.size(); ++h) add(of_plate(h, sigma, diagonals));
  for (std::size_t d = 0; d < claim_.springs.size(); ++d) {
    if (claim_.springs[d].rate_n_per_mm == 0) continue;
    add(of_spring(d, sigma, diagonals.stretches[d], diagonals.slopes[d]));
  }
  return sum;
}

// Its force F and F^2 / 2 k; twice its slope, N panel widths.
EnergyAlong EnergySlope::of_spring(std::size_t diagonal, const PathModel& sigma,
                                   const PathModel& stretch, const PathModel& slope) const {
  const ClaimedSpring& spring = claim_.springs[diagonal];
  const PathModel flat(flat_.squares[diagonal]), change = sigma * stretch;
  const PathModel flat_length(square_root(flat_.squares[diagonal]));
  const PathModel length = square_root(flat + change);
  const PathModel by_length = slope * reciprocal(length);
  const PathModel stiffness =
      PathModel(spring.rate_n_per_mm) * PathModel(width_mm_) * reciprocal(length + flat_length);
  PathModel preload;
  if (spring.free_mm) {
    preload = PathModel(spring.rate_n_per_mm) *
              (PathModel(width_mm_) * flat_length - PathModel(*spring.free_mm));
  } else if (spring.preload_n != 0) {
    assert(!sides_.empty());
    if (sides_[diagonal] == 0) return unknown();
    preload = PathModel(sides_[diagonal] * spring.preload_n);
  }
  const PathModel force = stiffness * change + preload;
  const PathModel n_mm = PathModel(reciprocal(Ball(2 * spring.rate_n_per_mm))) * force * force;
  return {n_mm, (is_relaxed_flat_ ? stiffness * stretch : force) * by_length};
}

// Four times its slope. A, B are the squares of the diagonals, c is their product; A0, B0, c0 are
// those of the cut-out, D0 = A0 B0 - c0^2. Hence I1 = (B0 A + A0 B - 2 c0 c) / D0 and J^2 = (A B -
// c^2) / D0. It is tense if J^4 exceeds l1^2, the larger root of x^2 - I1 x + J^2.
EnergyAlong EnergySlope::of_plate(std::size_t hole, const PathModel& sigma,
                                  const DiagonalsAlong& diagonals) const {
  const std::size_t i = 2 * hole, k = i + 1;
  const ClaimedPlate& plate = claim_.plates[hole];
  const Ball p(plate.of_flat[0]), q(plate.of_flat[1]);
  const Ball a0 = p * p * flat_.squares[i], b0 = q * q * flat_.squares[k];
  const Ball c = flat_.products[hole], c0 = p * q * c;
  const Ball d0 = a0 * b0 - c0 * c0;
  const PathModel inverse(reciprocal(d0));
  const PathModel a = PathModel(flat_.squares[i]) + sigma * diagonals.stretches[i];
  const PathModel b = PathModel(flat_.squares[k]) + sigma * diagonals.stretches[k];
  const PathModel& a_rate = diagonals.slopes[i];
  const PathModel& b_rate = diagonals.slopes[k];
  const PathModel trace =
      inverse * (PathModel(b0) * a + PathModel(a0) * b - 2.0 * PathModel(c0 * c));
  const PathModel square = inverse * (a * b - PathModel(c * c)), fourth = square * square;
  const bool is_tense = is_proven_positive(2.0 * fourth - trace) &&
                        is_proven_positive(fourth * fourth - trace * fourth + square);
  if (!is_tense) return unknown();
  const PathModel by_trace = PathModel(b0) * a_rate + PathModel(a0) * b_rate;
  const PathModel by_square = a_rate * b + a * b_rate;
  const Ball shear = Ball(plate.shear_n_per_mm) * square_root(d0);
  const PathModel factor = PathModel(shear) * inverse;
  const PathModel value = trace + reciprocal(square) - PathModel(3.0);
  const Ball area = 0.25 * shear * Ball(width_mm_) * Ball(width_mm_);
  return {PathModel(area) * value, factor * (by_trace - reciprocal(fourth) * by_square)};
}

}  // namespace misalign::solver
