// Numbers and functions with proven errors. A Taylor model is a polynomial in s, -1 <= s <= 1, and
// a radius: it stands for every function whose distance from the polynomial is nowhere larger. One
// of degree 0 is a number known to within its radius (midpoint-radius arithmetic; Rump 1999, Berz &
// Makino 1998).
//
// All sums and products are rounded to nearest, no rounding mode is switched, and each result's
// radius includes its rounding error. With u = 2^-53:
//   fl(a + b) is off by at most u |fl(a + b)|; never by underflow
//   fl(a b) by at most u |a b|, or by 2^-1075 where it underflows
//   a sum of n products in any order by at most (n u / (1 - n u)) times the sum of their sizes
// (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., sections 2.2 and 3.1). A radius
// is itself a sum of products, all of them positive, of fewer than kMostOperations operations, so
// that the exact one is at most kUp times what was computed. Infinite or undefined numbers stay
// what they are: a test that must hold is written such that it fails for them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solver/certificate/call.hpp"

namespace misalign::solver {

inline constexpr double kUnit = 0x1p-53;
inline constexpr int kMostOperations = 20000;
/// Upper bound of (1 - u)^-kMostOperations.
inline constexpr double kUp = 1 + 2 * kMostOperations * kUnit;
/// More than kMostOperations underflows of 2^-1075 each, and far below any error that counts.
inline constexpr double kUnderflow = 0x1p-1000;

/// Returns whether this thread's arithmetic is that of the bounds: it rounds to nearest, and keeps
/// numbers below 2^-1022.
inline bool rounds_as_proven() {
  volatile const double unity = 1, a_little = 0x1p-53, more = 0x1.8p-53, least = 0x1p-1022;
  return unity + a_little == 1 && unity + more == 1 + 0x1p-52 && least * 0.5 > 0;
}

template <int Degree>
struct TaylorModel {
  std::array<double, Degree + 1> c{};  ///< coefficients of 1, s, s^2, ...
  double radius = 0;

  TaylorModel() = default;
  /// An exact constant.
  TaylorModel(double constant) { c[0] = constant; }  // NOLINT: a number is a Taylor model
  /// A number as a constant.
  template <int Lower>
  explicit TaylorModel(const TaylorModel<Lower>& number) requires(Lower == 0 && Degree > 0)
      : TaylorModel(TaylorModel::number(number.c[0], number.radius)) {}
  /// A number within `error` of `middle`.
  static TaylorModel number(double middle, double error) {
    TaylorModel result(middle);
    result.radius = error;
    return result;
  }
  static TaylorModel line(double constant, double slope) {
    static_assert(Degree >= 1);
    TaylorModel result(constant);
    result.c[1] = slope;
    return result;
  }

  /// Bound of the polynomial's size, without its radius; rounded, see kUp.
  double size() const {
    double sum = 0;
    for (const double k : c) sum += std::abs(k);
    return sum;
  }
  /// Upper bound of |f(s)| for every s.
  double bound() const { return kUp * (size() + radius); }

  TaylorModel operator-() const {
    TaylorModel result;
    for (int k = 0; k <= Degree; ++k) result.c[k] = -c[k];
    result.radius = radius;
    return result;
  }
  friend TaylorModel operator+(const TaylorModel& a, const TaylorModel& b) {
    TaylorModel result;
    for (int k = 0; k <= Degree; ++k) result.c[k] = a.c[k] + b.c[k];
    result.radius = kUp * (a.radius + b.radius + kUnit * result.size());
    return result;
  }
  friend TaylorModel operator-(const TaylorModel& a, const TaylorModel& b) {
    TaylorModel result;
    for (int k = 0; k <= Degree; ++k) result.c[k] = a.c[k] - b.c[k];
    result.radius = kUp * (a.radius + b.radius + kUnit * result.size());
    return result;
  }
  friend TaylorModel operator*(double k, const TaylorModel& a) {
    TaylorModel result;
    for (int i = 0; i <= Degree; ++i) result.c[i] = k * a.c[i];
    result.radius = kUp * (std::abs(k) * a.radius + kUnit * result.size()) + kUnderflow;
    return result;
  }
  /// Powers above the degree go into the radius.
  MISALIGN_CALL friend TaylorModel operator*(const TaylorModel& a, const TaylorModel& b) {
    TaylorModel result;
    double left_out = 0, tail = 0, size_a = std::abs(a.c[0]);
    for (int i = 0; i <= Degree; ++i) result.c[i] = a.c[0] * b.c[i];
    for (int i = 1; i <= Degree; ++i) {
      for (int j = 0; i + j <= Degree; ++j) result.c[i + j] += a.c[i] * b.c[j];
      const double size = std::abs(a.c[i]);
      size_a += size;
      tail += std::abs(b.c[Degree + 1 - i]);
      left_out += size * tail;
    }
    const double size_b = tail + std::abs(b.c[0]);
    result.radius = kUp * (left_out + (Degree + 2) * kUnit * (size_a * size_b) + size_a * b.radius +
                           a.radius * (size_b + b.radius)) +
                    kUnderflow;
    return result;
  }
  TaylorModel& operator+=(const TaylorModel& b) { return *this = *this + b; }
  TaylorModel& operator-=(const TaylorModel& b) { return *this = *this - b; }
};

/// A number known to within a radius.
using Ball = TaylorModel<0>;

/// 1 / f; its radius is infinite where f is not known to stay away from zero. With y near 1 / f(0)
/// and e = 1 - f y: 1 / f = y (1 + e + e^2 + ... ), with the remainder e^(n + 1) / (1 - e).
template <int Degree>
TaylorModel<Degree> reciprocal(const TaylorModel<Degree>& f) {
  const double y = 1 / f.c[0];
  const TaylorModel<Degree> e = TaylorModel<Degree>(1) - y * f;
  const double most = e.bound();
  if (!(most < 0.5)) {
    return TaylorModel<Degree>::number(y, std::numeric_limits<double>::infinity());
  }
  TaylorModel<Degree> sum(1);
  double left_out = most;
  // Terms are added until the remainder is below rounding; most < 1/2 needs at most 53.
  for (int n = 0; n < 60 && left_out > kUnit; ++n) {
    sum = TaylorModel<Degree>(1) + e * sum;
    left_out = kUp * (left_out * most);
  }
  sum.radius = kUp * (sum.radius + 2 * left_out);
  return y * sum;
}

/// The same function as a polynomial of lower degree.
template <int Degree, int Higher>
TaylorModel<Degree> lower(const TaylorModel<Higher>& f) {
  static_assert(Degree <= Higher);
  TaylorModel<Degree> result;
  double left_out = 0;
  for (int k = 0; k <= Higher; ++k) {
    if (k <= Degree) {
      result.c[k] = f.c[k];
    } else {
      left_out += std::abs(f.c[k]);
    }
  }
  result.radius = kUp * (f.radius + left_out);
  return result;
}

/// The derivative of its polynomial, by s.
template <int Degree>
TaylorModel<Degree> derivative(const TaylorModel<Degree>& f) {
  TaylorModel<Degree> rate;
  for (int k = 1; k <= Degree; ++k) rate.c[k - 1] = k * f.c[k];
  rate.radius = kUp * kUnit * rate.size();
  return rate;
}

/// f at one s, known to within its radius; |s| <= 1.
template <int Degree>
Ball value_at(const TaylorModel<Degree>& f, const Ball& s) {
  Ball sum(f.c[Degree]);
  for (int k = Degree - 1; k >= 0; --k) sum = sum * s + Ball(f.c[k]);
  sum.radius = kUp * (sum.radius + f.radius);
  return sum;
}

/// Its polynomial at one s, as if that were exact.
template <int Degree>
Ball polynomial_at(TaylorModel<Degree> f, const Ball& s) {
  f.radius = 0;
  return value_at(f, s);
}

/// The powers up to `degree` of its polynomial at one s, rounded: a guess.
template <int Degree>
double guess_at(const TaylorModel<Degree>& f, double s, int degree = Degree) {
  double sum = 0;
  for (int k = degree; k >= 0; --k) sum = sum * s + f.c[k];
  return sum;
}

/// Square root of a number; its radius is infinite where that is not known to be positive. The
/// correctly rounded root of the middle has a relative error of u; |sqrt(m + d) - sqrt(m)| <= |d| /
/// sqrt(m).
inline Ball square_root(const Ball& x) {
  const double root = std::sqrt(x.c[0]);
  const bool is_positive = x.c[0] > kUp * x.radius;
  return Ball::number(root, is_positive ? kUp * (kUnit * root + x.radius / root) + kUnderflow
                                        : std::numeric_limits<double>::infinity());
}

/// Square root of a function; its radius is infinite where that is not known to be positive. For
/// any polynomial g of at least m > 0: |sqrt(f) - g| = |f - g^2| / (sqrt(f) + g) <= |f - g^2| / m.
/// Here g has the root's powers.
template <int Degree>
TaylorModel<Degree> square_root(const TaylorModel<Degree>& f) {
  TaylorModel<Degree> g;
  g.c[0] = std::sqrt(f.c[0]);
  double least = g.c[0];
  for (int k = 1; k <= Degree; ++k) {
    double rest = f.c[k];
    for (int i = 1; i < k; ++i) rest -= g.c[i] * g.c[k - i];
    g.c[k] = rest / (2 * g.c[0]);
    least -= kUp * std::abs(g.c[k]);
  }
  const double off = (f - g * g).bound();
  const bool is_positive = least > 0 && off < 0.5 * (least * least);
  g.radius = is_positive ? kUp * (off / least) : std::numeric_limits<double>::infinity();
  return g;
}

}  // namespace misalign::solver
