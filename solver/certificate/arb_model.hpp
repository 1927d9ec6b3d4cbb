// The checker's arithmetic: functions of s, -1 <= s <= 1, as polynomials whose coefficients are
// balls of FLINT's arb. A model stands for every function f such that at each s, f(s) is a value of
// the polynomial for some choice within the balls. So errors go into the ball of the constant, and
// so do powers above the degree. A model of degree 0 is a number.
#pragma once

#include <array>

#if __has_include(<flint/arb.h>)
#include <flint/arb.h>
#include <flint/arb_poly.h>
#else
#include <arb.h>
#include <arb_poly.h>
#endif

#include "solver/certificate/call.hpp"

namespace misalign::solver {

/// Two words of 64 bits: the longest numbers that arb keeps without a heap of their own.
inline constexpr slong kArbBits = 120;

/// An upper bound of a size.
class ArbBound {
 public:
  ArbBound() { mag_init(value_); }
  ArbBound(const ArbBound&) = delete;
  ArbBound& operator=(const ArbBound&) = delete;
  ~ArbBound() { mag_clear(value_); }
  mag_ptr get() { return value_; }
  mag_srcptr get() const { return value_; }

 private:
  mag_t value_;
};

template <int Degree>
class ArbModel {
 public:
  MISALIGN_CALL ArbModel() {
    for (arb_struct& k : c_) arb_init(&k);
  }
  /// An exact constant.
  ArbModel(double constant) : ArbModel() { arb_set_d(&c_[0], constant); }  // NOLINT: a number
  explicit ArbModel(const ArbModel<0>& number) requires(Degree > 0) : ArbModel() {
    arb_set(&c_[0], number[0]);
  }
  MISALIGN_CALL ArbModel(const ArbModel& b) : ArbModel() { *this = b; }
  MISALIGN_CALL ArbModel(ArbModel&& b) noexcept : ArbModel() { swap(b); }
  MISALIGN_CALL ArbModel& operator=(const ArbModel& b) {
    for (int k = 0; k <= Degree; ++k) arb_set(&c_[k], &b.c_[k]);
    return *this;
  }
  MISALIGN_CALL ArbModel& operator=(ArbModel&& b) noexcept {
    swap(b);
    return *this;
  }
  MISALIGN_CALL ~ArbModel() {
    for (arb_struct& k : c_) arb_clear(&k);
  }

  arb_ptr operator[](int k) { return &c_[k]; }
  arb_srcptr operator[](int k) const { return &c_[k]; }

  void widen(const ArbBound& error) { arb_add_error_mag(&c_[0], error.get()); }

  MISALIGN_CALL ArbModel operator-() const {
    ArbModel result;
    for (int k = 0; k <= Degree; ++k) arb_neg(result[k], &c_[k]);
    return result;
  }
  MISALIGN_CALL friend ArbModel operator+(const ArbModel& a, const ArbModel& b) {
    ArbModel result;
    for (int k = 0; k <= Degree; ++k) arb_add(result[k], a[k], b[k], kArbBits);
    return result;
  }
  MISALIGN_CALL friend ArbModel operator-(const ArbModel& a, const ArbModel& b) {
    ArbModel result;
    for (int k = 0; k <= Degree; ++k) arb_sub(result[k], a[k], b[k], kArbBits);
    return result;
  }
  MISALIGN_CALL friend ArbModel operator*(const ArbModel& a, const ArbModel& b) {
    ArbModel result;
    for (int k = 0; k <= Degree; ++k) {
      arb_dot(result[k], nullptr, 0, a[0], 1, b[k], -1, k + 1, kArbBits);
    }
    if constexpr (Degree > 0) {
      ArbBound left_out, tail, size;
      for (int i = 1; i <= Degree; ++i) {  // a's s^i meets b's powers above Degree - i
        arb_get_mag(size.get(), b[Degree + 1 - i]);
        mag_add(tail.get(), tail.get(), size.get());
        arb_get_mag(size.get(), a[i]);
        mag_addmul(left_out.get(), size.get(), tail.get());
      }
      result.widen(left_out);
    }
    return result;
  }
  MISALIGN_CALL ArbModel& operator+=(const ArbModel& b) {
    for (int k = 0; k <= Degree; ++k) arb_add(&c_[k], &c_[k], b[k], kArbBits);
    return *this;
  }
  /// Adds a number times a model.
  MISALIGN_CALL void add_product(const ArbModel<0>& k, const ArbModel& b) {
    for (int i = 0; i <= Degree; ++i) arb_addmul(&c_[i], k[0], b[i], kArbBits);
  }

 private:
  void swap(ArbModel& b) {
    for (int k = 0; k <= Degree; ++k) arb_swap(&c_[k], &b.c_[k]);
  }

  std::array<arb_struct, Degree + 1> c_;
};

using ArbNumber = ArbModel<0>;

inline ArbNumber operator/(const ArbNumber& a, const ArbNumber& b) {
  ArbNumber result;
  arb_div(result[0], a[0], b[0], kArbBits);
  return result;
}
/// Comparisons hold for certain: they are false where the balls overlap, or a number is undefined.
inline bool operator<(const ArbNumber& a, const ArbNumber& b) { return arb_lt(a[0], b[0]); }
inline bool operator<=(const ArbNumber& a, const ArbNumber& b) { return arb_le(a[0], b[0]); }
/// The middle of its ball, rounded: a guess.
inline double as_double(const ArbNumber& x) { return arf_get_d(arb_midref(x[0]), ARF_RND_NEAR); }
inline ArbNumber root_of(const ArbNumber& x) {
  ArbNumber root;
  arb_sqrt(root[0], x[0], kArbBits);
  return root;
}
inline ArbNumber size_of(const ArbNumber& a) {
  ArbNumber result;
  arb_abs(result[0], a[0]);
  return result;
}
/// An upper bound of |f(s)| for every s.
template <int Degree>
ArbNumber most_of(const ArbModel<Degree>& f) {
  ArbBound most, size;
  for (int k = 0; k <= Degree; ++k) {
    arb_get_mag(size.get(), f[k]);
    mag_add(most.get(), most.get(), size.get());
  }
  ArbNumber result;
  arf_set_mag(arb_midref(result[0]), most.get());
  return result;
}

template <int Degree>
ArbModel<Degree> scaled(const ArbNumber& k, const ArbModel<Degree>& f) {
  ArbModel<Degree> result;
  for (int i = 0; i <= Degree; ++i) arb_mul(result[i], k[0], f[i], kArbBits);
  return result;
}

/// 1 / f; undefined where f is not known to stay away from zero. With any polynomial g and e = 1 -
/// f g: 1 / f = g + g e / (1 - e).
template <int Degree>
ArbModel<Degree> reciprocal(const ArbModel<Degree>& f) {
  ArbModel<Degree> g, middle;
  for (int k = 0; k <= Degree; ++k) arb_get_mid_arb(middle[k], f[k]);
  _arb_poly_inv_series(g[0], middle[0], Degree + 1, Degree + 1, kArbBits);
  const ArbNumber e = most_of(ArbModel<Degree>(1.0) - f * g);
  if (!(e < ArbNumber(1.0))) {
    arb_indeterminate(g[0]);
    return g;
  }
  ArbBound left_out;
  arb_get_mag(left_out.get(), (most_of(g) * e / (ArbNumber(1.0) - e))[0]);
  g.widen(left_out);
  return g;
}

/// f at one s.
template <int Degree>
ArbNumber value_at(const ArbModel<Degree>& f, const ArbNumber& s) {
  ArbNumber result;
  _arb_poly_evaluate(result[0], f[0], Degree + 1, s[0], kArbBits);
  return result;
}

/// A claim is proven, disproven, or neither.
enum class Proof { holds, fails, unclear };

/// Proves f > 0 on the part of [-1, 1] round `middle`, by halving it.
template <int Degree>
Proof is_positive(const ArbModel<Degree>& f, double middle = 0, double half = 1) {
  ArbModel<Degree> shifted = f;
  const ArbNumber shift(middle);
  for (int i = 0; i < Degree; ++i) {
    for (int k = Degree - 1; k >= i; --k) {
      arb_addmul(shifted[k], shifted[k + 1], shift[0], kArbBits);
    }
  }
  ArbNumber at_middle;
  arb_set(at_middle[0], shifted[0]);
  if (at_middle < ArbNumber(0.0)) return Proof::fails;
  ArbNumber rest, power(1.0);
  for (int k = 1; k <= Degree; ++k) {
    power = power * ArbNumber(half);
    ArbNumber size;
    arb_abs(size[0], shifted[k]);
    rest += size * power;
  }
  if (rest < at_middle) return Proof::holds;
  constexpr double kSmallest = 0x1p-8;
  if (half <= kSmallest || !(ArbNumber(0.0) < at_middle)) return Proof::unclear;
  const Proof left = is_positive(f, middle - half / 2, half / 2);
  return left == Proof::holds ? is_positive(f, middle + half / 2, half / 2) : left;
}

}  // namespace misalign::solver
