// Numbers for the closure's formulas besides arb's models: polynomials of doubles, with which the
// checker guesses a path before it proves it, and values together with their rates.
#pragma once

#include <array>

#include "solver/certificate/arb_model.hpp"
#include "solver/certificate/pose_closure.hpp"

namespace misalign::solver {

/// A polynomial in s without any claim.
template <int Degree>
struct WitnessPolynomial {
  std::array<double, Degree + 1> c{};

  WitnessPolynomial() = default;
  WitnessPolynomial(double constant) { c[0] = constant; }  // NOLINT: a number is a polynomial

  MISALIGN_CALL WitnessPolynomial operator-() const { return scaled(-1, *this); }
  MISALIGN_CALL friend WitnessPolynomial operator+(const WitnessPolynomial& a,
                                                   const WitnessPolynomial& b) {
    WitnessPolynomial result;
    for (int k = 0; k <= Degree; ++k) result.c[k] = a.c[k] + b.c[k];
    return result;
  }
  MISALIGN_CALL friend WitnessPolynomial operator-(const WitnessPolynomial& a,
                                                   const WitnessPolynomial& b) {
    WitnessPolynomial result;
    for (int k = 0; k <= Degree; ++k) result.c[k] = a.c[k] - b.c[k];
    return result;
  }
  MISALIGN_CALL friend WitnessPolynomial operator*(const WitnessPolynomial& a,
                                                   const WitnessPolynomial& b) {
    WitnessPolynomial result;
    for (int i = 0; i <= Degree; ++i) {
      for (int j = 0; i + j <= Degree; ++j) result.c[i + j] += a.c[i] * b.c[j];
    }
    return result;
  }
  MISALIGN_CALL friend WitnessPolynomial scaled(double k, const WitnessPolynomial& a) {
    WitnessPolynomial result;
    for (int i = 0; i <= Degree; ++i) result.c[i] = k * a.c[i];
    return result;
  }
};

/// The series of 1 / f.
template <int Degree>
WitnessPolynomial<Degree> inverse_of(const WitnessPolynomial<Degree>& f) {
  WitnessPolynomial<Degree> g(1 / f.c[0]);
  for (int k = 1; k <= Degree; ++k) {
    double sum = 0;
    for (int i = 1; i <= k; ++i) sum += f.c[i] * g.c[k - i];
    g.c[k] = -sum * g.c[0];
  }
  return g;
}

/// A value and its derivative with respect to s.
template <class T>
struct WithRate {
  T value, rate;

  WithRate() = default;
  WithRate(double constant) : value(constant) {}  // NOLINT: a number is a constant
  WithRate(T at, T changes) : value(std::move(at)), rate(std::move(changes)) {}

  WithRate operator-() const { return {-value, -rate}; }
  friend WithRate operator+(const WithRate& a, const WithRate& b) {
    return {a.value + b.value, a.rate + b.rate};
  }
  friend WithRate operator-(const WithRate& a, const WithRate& b) {
    return {a.value - b.value, a.rate - b.rate};
  }
  friend WithRate operator*(const WithRate& a, const WithRate& b) {
    return {a.value * b.value, a.value * b.rate + a.rate * b.value};
  }
  friend WithRate scaled(const ArbNumber& k, const WithRate& a) {
    return {scaled(k, a.value), scaled(k, a.rate)};
  }
};

template <class T>
WithRate<T> inverse_of(const WithRate<T>& f) {
  const T inverse = inverse_of(f.value);
  return {inverse, -(f.rate * (inverse * inverse))};
}

template <int Degree>
struct NumberOf<ArbModel<Degree>> {
  using Type = ArbNumber;
};
template <class T>
struct NumberOf<WithRate<T>> {
  using Type = ArbNumber;
};

}  // namespace misalign::solver
