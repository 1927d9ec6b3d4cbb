// Motions of panels, stored by orders of smallness near flat, with tau = tan(half the pilot's
// angle) and sigma = tau^2:
//     R = I + [ sigma a   tau b  ]      t = ( sigma t1, sigma t2, tau t3 )
//             [ tau c     sigma d]
// Products keep that form and hold sigma only; with sigma = 1 they are common poses.
#pragma once

#include <array>
#include <utility>

namespace misalign::solver {

template <class T>
struct Motion {
  std::array<std::array<T, 2>, 2> a{};
  std::array<T, 2> b{}, c{};
  T d{};
  std::array<T, 3> t{};

  friend Motion operator+(const Motion& p, const Motion& q) {
    Motion sum;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) sum.a[i][j] = p.a[i][j] + q.a[i][j];
      sum.b[i] = p.b[i] + q.b[i];
      sum.c[i] = p.c[i] + q.c[i];
    }
    sum.d = p.d + q.d;
    for (int i = 0; i < 3; ++i) sum.t[i] = p.t[i] + q.t[i];
    return sum;
  }
  Motion transposed() const {
    Motion result = *this;
    std::swap(result.a[0][1], result.a[1][0]);
    std::swap(result.b, result.c);
    return result;
  }
};

/// sigma, a number or a function; or 1, which costs nothing.
template <class T>
struct Grading {
  bool graded;
  T sigma;
  T operator()(const T& value) const { return graded ? sigma * value : value; }
};

/// Terms of a product of motions beyond their sum: (R_p - I) (R_q - I), and (R_p - I) t_q.
template <class T>
Motion<T> beyond_sum(const Grading<T>& sigma, const Motion<T>& p, const Motion<T>& q) {
  Motion<T> r;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      r.a[i][j] = sigma(p.a[i][0] * q.a[0][j] + p.a[i][1] * q.a[1][j]) + p.b[i] * q.c[j];
    }
    r.b[i] = sigma(p.a[i][0] * q.b[0] + p.a[i][1] * q.b[1] + p.b[i] * q.d);
    r.c[i] = sigma(p.c[0] * q.a[0][i] + p.c[1] * q.a[1][i] + p.d * q.c[i]);
    r.t[i] = sigma(p.a[i][0] * q.t[0] + p.a[i][1] * q.t[1]) + p.b[i] * q.t[2];
  }
  r.d = p.c[0] * q.b[0] + p.c[1] * q.b[1] + sigma(p.d * q.d);
  r.t[2] = sigma(p.c[0] * q.t[0] + p.c[1] * q.t[1] + p.d * q.t[2]);
  return r;
}

/// p after q.
template <class T>
Motion<T> composed(const Grading<T>& sigma, const Motion<T>& p, const Motion<T>& q) {
  return p + q + beyond_sum(sigma, p, q);
}

}  // namespace misalign::solver
