// Polynomials in s without errors: the guesses of proofs.
#pragma once

#include <array>

#include "solver/certificate/call.hpp"

namespace misalign::solver {

template <int Degree>
struct Polynomial {
  std::array<double, Degree + 1> c{};

  Polynomial() = default;
  Polynomial(double constant) { c[0] = constant; }  // NOLINT: a number is a polynomial
  static Polynomial line(double constant, double slope) {
    Polynomial result(constant);
    result.c[1] = slope;
    return result;
  }
  Polynomial operator-() const { return -1.0 * *this; }
  friend Polynomial operator+(const Polynomial& a, const Polynomial& b) {
    Polynomial result;
    for (int k = 0; k <= Degree; ++k) result.c[k] = a.c[k] + b.c[k];
    return result;
  }
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b) {
    Polynomial result;
    for (int k = 0; k <= Degree; ++k) result.c[k] = a.c[k] - b.c[k];
    return result;
  }
  friend Polynomial operator*(double k, const Polynomial& a) {
    Polynomial result;
    for (int i = 0; i <= Degree; ++i) result.c[i] = k * a.c[i];
    return result;
  }
  MISALIGN_CALL friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial result;
    for (int i = 0; i <= Degree; ++i) {
      for (int j = 0; i + j <= Degree; ++j) result.c[i + j] += a.c[i] * b.c[j];
    }
    return result;
  }
  Polynomial& operator+=(const Polynomial& b) { return *this = *this + b; }
};

inline double reciprocal(double x) { return 1 / x; }
template <int Degree>
Polynomial<Degree> reciprocal(const Polynomial<Degree>& f) {
  Polynomial<Degree> result(1 / f.c[0]);
  for (int k = 1; k <= Degree; ++k) {
    double sum = 0;
    for (int j = 1; j <= k; ++j) sum += f.c[j] * result.c[k - j];
    result.c[k] = -sum * result.c[0];
  }
  return result;
}

}  // namespace misalign::solver
