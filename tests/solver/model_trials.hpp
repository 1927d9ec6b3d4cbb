// Trials of Taylor models against MPFI: random models, random functions within them, and whether
// what comes out of an operation holds what the operation makes of these functions.
#pragma once

#include <mpfi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "solver/certificate/taylor_model.hpp"

namespace misalign::solver {

/// A real number to within 2^-500 of itself.
class Enclosed {
 public:
  Enclosed(double value = 0) {  // NOLINT: a number
    mpfi_init2(x_, 500);
    mpfi_set_d(x_, value);
  }
  Enclosed(const Enclosed& b) : Enclosed() { mpfi_set(x_, b.x_); }
  Enclosed& operator=(const Enclosed& b) {
    mpfi_set(x_, b.x_);
    return *this;
  }
  ~Enclosed() { mpfi_clear(x_); }
  mpfi_ptr get() { return x_; }
  mpfi_srcptr get() const { return x_; }

  friend Enclosed operator+(const Enclosed& a, const Enclosed& b) { return of(mpfi_add, a, b); }
  friend Enclosed operator-(const Enclosed& a, const Enclosed& b) { return of(mpfi_sub, a, b); }
  friend Enclosed operator*(const Enclosed& a, const Enclosed& b) { return of(mpfi_mul, a, b); }
  friend Enclosed operator/(const Enclosed& a, const Enclosed& b) { return of(mpfi_div, a, b); }

  /// Its size, rounded down to a double; and whether it is more than that double for certain.
  double size() const {
    mpfr_t least;
    mpfr_init2(least, 500);
    mpfi_mig(least, x_);
    const double result = mpfr_get_d(least, MPFR_RNDD);
    mpfr_clear(least);
    return result;
  }
  bool is_larger_than(double limit) const {
    mpfr_t least;
    mpfr_init2(least, 500);
    mpfi_mig(least, x_);
    const bool result = mpfr_cmp_d(least, limit) > 0;
    mpfr_clear(least);
    return result;
  }

 private:
  template <class Operation>
  static Enclosed of(Operation operation, const Enclosed& a, const Enclosed& b) {
    Enclosed result;
    operation(result.x_, a.x_, b.x_);
    return result;
  }
  mpfi_t x_;
};

/// The polynomial of a model at s, and a function within the model: `share` of its radius off.
template <int Degree>
Enclosed polynomial_at(const TaylorModel<Degree>& f, const Enclosed& s) {
  Enclosed sum(f.c[Degree]);
  for (int k = Degree - 1; k >= 0; --k) sum = sum * s + Enclosed(f.c[k]);
  return sum;
}
template <int Degree>
Enclosed function_at(const TaylorModel<Degree>& f, double share, const Enclosed& s) {
  return polynomial_at(f, s) + Enclosed(share) * Enclosed(f.radius);
}

/// What a kind of operation went through.
struct TrialCount {
  std::string name;
  long trials = 0, broken = 0;
  long silent = 0;           ///< the radius is infinite or undefined: nothing is claimed
  double most_of_error = 0;  ///< largest error of operands without any, as a share of the radius
};

class ModelTrials {
 public:
  /// Radii of results are taken times `trust`: what is less than 1 must be seen to break.
  explicit ModelTrials(std::uint64_t seed, double trust = 1) : random_(seed), trust_(trust) {}

  /// Every operation once, of every degree.
  void run() {
    next_ = 0;
    run_degree<0>();
    run_degree<3>();
    run_degree<7>();
    value_of_degree<0>();
    value_of_degree<7>();
    root();
    lower_degree<7, 3>();
    lower_degree<3, 0>();
  }
  const std::vector<TrialCount>& counts() const { return counts_; }
  long trials() const {
    long sum = 0;
    for (const TrialCount& count : counts_) sum += count.trials;
    return sum;
  }
  long broken() const {
    long sum = 0;
    for (const TrialCount& count : counts_) sum += count.broken;
    return sum;
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool once_in(int n) { return random_() % static_cast<unsigned>(n) == 0; }
  double sign() { return once_in(2) ? 1 : -1; }

  // Exponents of all of a model's numbers are near this, one for a trial: what meets another is of
  // its size, or not.
  int draw_exponent() {
    if (once_in(3)) return static_cast<int>(between(-996, 996));  // 1e-300 to 1e300
    if (once_in(4)) return static_cast<int>(between(-1074, -950));
    if (once_in(6)) return static_cast<int>(between(1000, 1023));
    return static_cast<int>(between(-20, 20));
  }
  double draw_number(int exponent) {
    if (once_in(12)) return 0;
    double fraction = between(1, 2);
    if (once_in(4)) fraction = 1;
    if (once_in(6)) fraction = std::nextafter(once_in(2) ? 1.0 : 2.0, 0);
    return sign() * std::ldexp(fraction, exponent - static_cast<int>(between(0, 3)));
  }

  template <int Degree>
  TaylorModel<Degree> draw_model(int exponent) {
    TaylorModel<Degree> f;
    const int fall = once_in(2) ? 0 : static_cast<int>(between(0, 30));
    for (int k = 0; k <= Degree; ++k) f.c[k] = draw_number(exponent - k * fall);
    if (once_in(2)) return f;  // exactly a polynomial: all of the result's radius is of rounding
    f.radius = std::abs(draw_number(exponent - static_cast<int>(between(0, 70))));
    return f;
  }

  // What nearly cancels f in a sum.
  template <int Degree>
  TaylorModel<Degree> draw_opposite(const TaylorModel<Degree>& f) {
    TaylorModel<Degree> g = -f;
    for (double& k : g.c) {
      if (once_in(3)) k *= 1 + sign() * 0x1p-52 * std::floor(between(0, 8));
    }
    return g;
  }

  double draw_place() {
    if (once_in(3)) return sign();
    if (once_in(8)) return 0;
    return between(-1, 1);
  }
  double draw_share() { return once_in(2) ? sign() : between(-1, 1); }

  TrialCount& count(const char* operation, int degree) {
    if (next_ == counts_.size()) {
      counts_.push_back({std::string(operation) + ", degree " + std::to_string(degree)});
    }
    return counts_[next_++];
  }

  // Whether `result` holds a function that has this value at s.
  template <int Degree>
  void expect(TrialCount& counted, const TaylorModel<Degree>& result, const Enclosed& value,
              const Enclosed& s, bool is_exact) {
    ++counted.trials;
    if (!std::isfinite(result.radius)) {
      ++counted.silent;
      return;
    }
    for (const double k : result.c) {
      if (!std::isfinite(k)) {
        ++counted.broken;
        return;
      }
    }
    const Enclosed error = polynomial_at(result, s) - value;
    if (error.is_larger_than(trust_ * result.radius)) ++counted.broken;
    if (is_exact && result.radius > 0) {
      counted.most_of_error = std::max(counted.most_of_error, error.size() / result.radius);
    }
  }

  template <int Degree>
  void run_degree() {
    using Operand = TaylorModel<Degree>;
    const int exponent = draw_exponent();
    const Operand f = draw_model<Degree>(exponent);
    const Operand g = once_in(3)   ? draw_opposite(f)
                      : once_in(2) ? draw_model<Degree>(exponent)
                                   : draw_model<Degree>(draw_exponent());
    const double place = draw_place(), factor = draw_number(draw_exponent());
    const double share_f = draw_share(), share_g = draw_share();
    const Enclosed s(place);
    const Enclosed at_f = function_at(f, share_f, s), at_g = function_at(g, share_g, s);
    const bool is_exact = f.radius == 0 && g.radius == 0;
    expect(count("a + b", Degree), f + g, at_f + at_g, s, is_exact);
    expect(count("a - b", Degree), f - g, at_f - at_g, s, is_exact);
    expect(count("a b", Degree), f * g, at_f * at_g, s, is_exact);
    expect(count("-a", Degree), -f, Enclosed(0) - at_f, s, is_exact);
    expect(count("number times a", Degree), factor * f, Enclosed(factor) * at_f, s, is_exact);
    TrialCount& bounds = count("bound of a", Degree);
    ++bounds.trials;
    if (at_f.is_larger_than(trust_ * f.bound())) ++bounds.broken;
    divide<Degree>(exponent, s, share_f);
  }

  // Mostly of what can be divided by: the other numbers are small beside the first.
  template <int Degree>
  void divide(int exponent, const Enclosed& s, double share) {
    TaylorModel<Degree> f = draw_model<Degree>(exponent - static_cast<int>(between(0, 20)));
    f.c[0] = sign() * std::ldexp(between(1, 2), exponent);
    const TaylorModel<Degree> inverse = reciprocal(f);
    TrialCount& counted = count("1 / a", Degree);
    if (!std::isfinite(inverse.radius)) {  // where a may be zero there is nothing to compare with
      ++counted.trials;
      ++counted.silent;
      return;
    }
    expect(counted, inverse, Enclosed(1) / function_at(f, share, s), s, f.radius == 0);
  }

  template <int Degree>
  void value_of_degree() {
    const TaylorModel<Degree> f = draw_model<Degree>(draw_exponent());
    const Ball s = once_in(2) ? Ball(draw_place())
                              : Ball::number(between(-0.9, 0.9),
                                             std::ldexp(0.1, -static_cast<int>(between(0, 60))));
    const double share = draw_share(), share_f = draw_share();
    const Enclosed place = function_at(s, share, Enclosed(0));
    expect(count("a at s", Degree), value_at(f, s), function_at(f, share_f, place), Enclosed(0),
           f.radius == 0 && s.radius == 0);
  }

  void root() {
    Ball x = draw_model<0>(draw_exponent());
    x.c[0] = std::abs(x.c[0]);
    const Ball result = square_root(x);
    TrialCount& counted = count("square root", 0);
    if (!std::isfinite(result.radius)) {
      ++counted.trials;
      ++counted.silent;
      return;
    }
    Enclosed value = function_at(x, draw_share(), Enclosed(0));
    mpfi_sqrt(value.get(), value.get());
    expect(counted, result, value, Enclosed(0), x.radius == 0);
  }

  template <int Higher, int Degree>
  void lower_degree() {
    const TaylorModel<Higher> f = draw_model<Higher>(draw_exponent());
    const Enclosed s(draw_place());
    expect(count("lower", Degree), lower<Degree>(f), function_at(f, draw_share(), s), s, false);
  }

  std::mt19937_64 random_;
  double trust_;
  std::vector<TrialCount> counts_;
  std::size_t next_ = 0;
};

}  // namespace misalign::solver
