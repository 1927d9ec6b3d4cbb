#include "solver/pattern/degree_four.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Smallest nonzero sine of a sum of sectors. Below it two creases are one straight line, apart from
// the rounding of written coordinates, and another crease stays flat.
constexpr double kCollinear = kFlatFoldable_rad;

// An angle as its cosine and sine.
struct Turn {
  double c, s;
  Turn operator+(const Turn& o) const { return {c * o.c - s * o.s, s * o.c + c * o.s}; }
};

Turn between(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return {from.dot(to), from.x() * to.y() - from.y() * to.x()};
}

int sign_of(double value) { return value < 0 ? -1 : 1; }

}  // namespace

DegreeFourVertex::DegreeFourVertex(const std::array<Eigen::Vector2d, 4>& u, int opposite_sign)
    : opposite_sign_(opposite_sign) {
  assert(opposite_sign == 1 || opposite_sign == -1);
  for ([[maybe_unused]] const Eigen::Vector2d& direction : u)
    assert(std::abs(direction.norm() - 1) < 1e-9);
  const Turn a = between(u[0], u[1]), b = between(u[1], u[2]), c = between(u[2], u[3]),
             d = between(u[3], u[0]);
  flat_foldable_ = std::abs((a + c).s) < kFlatFoldable_rad;
  opposite_square_ = flat_foldable_ ? 1 : a.s * d.s / (b.s * c.s);
  const bool minus_root = opposite_sign < 0;
  const auto adjacent = [&](const Turn& a_, const Turn& b_, const Turn& d_) {
    return Adjacent{flat_foldable_ ? 0 : a_.s * (b_ + d_).s, (a_ + b_).s * d_.s, (a_ + d_).s * b_.s,
                    b_.s * d_.s, minus_root};
  };
  second_ = adjacent(a, b, d);
  fourth_ = adjacent(d, c, a);
  // If creases 1 and 3 fold alike and are one line, the other two stay flat; if they fold unlike
  // and the other two are one line, they stay flat themselves.
  if (std::abs(minus_root ? (a + d).s : (a + b).s) < kCollinear) return;
  const auto initial_sign = [&](const Adjacent& p) { return -sign_of(minus_root ? p.p02 : p.p20); };
  signs_ = {initial_sign(second_), opposite_sign, initial_sign(fourth_)};
}

// Next to flat t_2 / t_1 = (-p11 -+ sqrt(p11^2 - p20 p02)) / p02, where the square is sin a sin b
// sin c sin d sin b sin d and never zero: each way of folding keeps its root from vertex to vertex,
// and where creases 1 and 3 are one line it is seen to be the upper one that folds them unlike.
//
// Each root has the form that does not cancel. The denominator is positive next to flat and reaches
// zero when the crease reaches 180 degrees. At flat-foldable vertices p22 is zero and the cosine is
// a factor of all terms; it is taken out, so that 180 degrees is not zero over zero.
std::optional<HalfAngle<double>> DegreeFourVertex::Adjacent::follow(const HalfAngle<double>& first,
                                                                    double closed_rad) const {
  const double cosine = p22 == 0 ? 1 : first.c, factor = p22 == 0 ? first.c : 1;
  const double leading = p02 * cosine * cosine + p22 * first.s * first.s;
  const double square = p11 * p11 * cosine * cosine - p20 * leading;
  // Squared cosine of the opposite crease, times its flat value.
  if (square < -closed_rad * closed_rad * (p11 * p11 - p20 * p02)) return std::nullopt;
  const double q = p11 * cosine + std::sqrt(std::max(square, 0.0));
  const double denominator = factor * (minus_root ? leading * sign_of(p02) : q);
  const double numerator = first.s * (minus_root ? -q * sign_of(p02) : -p20);
  if (denominator < -closed_rad * std::abs(numerator)) return std::nullopt;
  return half_angle_of_ratio(numerator, std::max(denominator, 0.0));
}

std::optional<std::array<HalfAngle<double>, 3>> DegreeFourVertex::others(
    const HalfAngle<double>& first, double closed_rad) const {
  const auto second = second_.follow(first, closed_rad), fourth = fourth_.follow(first, closed_rad);
  // cos^2 = 1 - k sin^2 without the difference that rounding would spoil next to 180 degrees.
  const double cosine_square = first.c * first.c + (1 - opposite_square_) * first.s * first.s;
  if (!second || !fourth || cosine_square < -closed_rad * closed_rad) return std::nullopt;
  const HalfAngle<double> third =
      half_angle_of_ratio(opposite_sign_ * std::sqrt(opposite_square_) * first.s,
                          std::sqrt(std::max(cosine_square, 0.0)));
  return std::array{*second, third, *fourth};
}

}  // namespace misalign::solver
