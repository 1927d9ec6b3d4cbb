// A value and its derivative with respect to s, over any numbers.
#pragma once

#include <type_traits>

#include "solver/certificate/polynomial.hpp"

namespace misalign::solver {

/// A value and its derivative with respect to s.
template <class T>
struct Dual {
  T value{}, rate{};

  Dual() = default;
  Dual(double constant) : value(constant), rate(0.0) {}  // NOLINT: a number is a constant
  explicit Dual(const T& constant) requires(!std::is_same_v<T, double>)
      : value(constant), rate(0.0) {}
  Dual(const T& v, const T& r) : value(v), rate(r) {}

  Dual operator-() const { return {-value, -rate}; }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.rate + b.rate};
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.rate - b.rate};
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.rate + a.rate * b.value};
  }
  friend Dual operator*(double k, const Dual& a) { return {k * a.value, k * a.rate}; }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
};

template <class T>
Dual<T> reciprocal(const Dual<T>& x) {
  const T inverse = reciprocal(x.value);
  return {inverse, -(x.rate * (inverse * inverse))};
}

}  // namespace misalign::solver
