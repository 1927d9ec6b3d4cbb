// Operations on lanes beyond arithmetic: access to single lanes, and selection lane by lane. A
// double or a float is a register of one lane.
#pragma once

#include <cmath>
#include <type_traits>

// A flattened function is a fifth faster in lanes than calls that pass poses through memory. With
// the address sanitizer each would take minutes to compile.
#ifdef __SANITIZE_ADDRESS__
#define MISALIGN_FLATTEN
#else
#define MISALIGN_FLATTEN [[gnu::flatten]]
#endif

namespace misalign::solver {

namespace detail {

template <class T>
struct ScalarOf {
  using type = T;
};
template <class T>
requires requires { typename T::value_type; }
struct ScalarOf<T> {
  using type = typename T::value_type;
};

}  // namespace detail

/// The scalar type of a lane of T.
template <class T>
using Scalar = typename detail::ScalarOf<std::remove_const_t<T>>::type;

template <class T>
inline constexpr int kLanes = static_cast<int>(sizeof(T) / sizeof(Scalar<T>));

template <class T>
Scalar<T>& lane(T& value, int i) {
  return reinterpret_cast<Scalar<T>*>(&value)[i];
}
template <class T>
Scalar<T> lane(const T& value, int i) {
  return reinterpret_cast<const Scalar<T>*>(&value)[i];
}

/// A number in every lane, rounded to its scalar; for other types (dual numbers) a constant.
template <class T>
T constant(double value) {
  if constexpr (requires { typename T::value_type; }) {
    return T(static_cast<typename T::value_type>(value));
  } else {
    return static_cast<T>(value);
  }
}

/// Overloads for a single lane; registers find their library's `select` by argument.
inline double select(bool condition, double a, double b) { return condition ? a : b; }
inline float select(bool condition, float a, float b) { return condition ? a : b; }

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
