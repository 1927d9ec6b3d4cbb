// What the templates need beyond arithmetic: one value for each lane, read and written singly, and
// choices made lane by lane. A double is a register of one lane.
#pragma once

#include <cmath>

// One function is a fifth faster in lanes than calls that pass poses through memory. Under the
// address sanitizer the compiler would take minutes for each.
#ifdef __SANITIZE_ADDRESS__
#define MISALIGN_FLATTEN
#else
#define MISALIGN_FLATTEN [[gnu::flatten]]
#endif

namespace misalign::solver {

template <class T>
inline constexpr int kLanes = static_cast<int>(sizeof(T) / sizeof(double));

template <class T>
double& lane(T& value, int i) {
  return reinterpret_cast<double*>(&value)[i];
}
template <class T>
double lane(const T& value, int i) {
  return reinterpret_cast<const double*>(&value)[i];
}

/// Registers find their library's `select` by argument; this is the one of a single lane.
inline double select(bool condition, double a, double b) { return condition ? a : b; }

/// The larger of two; `a` where either is not a number, in every instruction set.
template <class T>
T larger(const T& a, const T& b) {
  return select(a < b, b, a);
}

template <class T>
T magnitude(const T& a) {
  using std::abs;
  return abs(a);
}

}  // namespace misalign::solver
