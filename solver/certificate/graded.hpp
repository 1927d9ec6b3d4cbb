// Rotations whose parts are stored by their order of smallness near flat. With tau = tan(rho_1 / 2)
// of the pilot, sigma = tau^2: fold angles and the in-plane parts of ball joints are of order tau,
// their normal parts of order tau^2. A graded quaternion stands for
//     w + tau x i + tau y j + tau^2 z k,
// a graded vector for (tau x, tau y, tau^2 z). Products keep that form and contain sigma only, so
// that nothing is divided by a small number and sigma = 0 is an angle like any other. With sigma =
// 1 they are the common quaternions and vectors: one set of formulas serves near flat and beyond.
//
// Sigma is a policy: a functor that multiplies by it.
#pragma once

namespace misalign::solver {

/// sigma as a number or a function; common quaternions, sigma = 1, have std::identity.
template <class T>
struct GradedBy {
  T sigma;
  T operator()(const T& value) const { return sigma * value; }
};

template <class T>
struct GradedVector {
  T x, y, z;
};

template <class T>
struct GradedQuaternion {
  T w, x, y, z;

  GradedQuaternion conjugate() const { return {w, -x, -y, -z}; }
  GradedVector<T> vector() const { return {x, y, z}; }
};

template <class T, class Sigma>
GradedQuaternion<T> product(const Sigma& sigma, const GradedQuaternion<T>& a,
                            const GradedQuaternion<T>& b) {
  return {a.w * b.w - sigma(a.x * b.x + a.y * b.y + sigma(a.z * b.z)),
          a.w * b.x + a.x * b.w + sigma(a.y * b.z - a.z * b.y),
          a.w * b.y + a.y * b.w + sigma(a.z * b.x - a.x * b.z),
          a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

/// The same where b.z = 0, as for a crease.
template <class T, class Sigma>
GradedQuaternion<T> product_in_plane(const Sigma& sigma, const GradedQuaternion<T>& a,
                                     const GradedQuaternion<T>& b) {
  return {a.w * b.w - sigma(a.x * b.x + a.y * b.y), a.w * b.x + a.x * b.w - sigma(a.z * b.y),
          a.w * b.y + a.y * b.w + sigma(a.z * b.x), a.z * b.w + a.x * b.y - a.y * b.x};
}

template <class T, class Sigma>
T squared_norm(const Sigma& sigma, const GradedQuaternion<T>& q) {
  return q.w * q.w + sigma(q.x * q.x + q.y * q.y + sigma(q.z * q.z));
}

/// The rotation of q displaces the vector v by (sigma x, sigma y, z) of the result, by order: R v -
/// v = (2 w t + 2 q x t) / |q|^2 with t = q x v. `inverse` is 1 / |q|^2. Both gradings of v occur:
/// an axis is (tau x, tau y, tau^2 z), an edge of the sheet (x, y, tau z).
template <class T, class Sigma>
GradedVector<T> displacement(const Sigma& sigma, const GradedQuaternion<T>& q, const T& inverse,
                             const GradedVector<T>& v) {
  const T t1 = q.y * v.z - q.z * v.y;
  const T t2 = q.z * v.x - q.x * v.z;
  const T t3 = q.x * v.y - q.y * v.x;
  const T twice = inverse + inverse;
  return {twice * (q.w * t1 + q.y * t3 - sigma(q.z * t2)),
          twice * (q.w * t2 - q.x * t3 + sigma(q.z * t1)),
          twice * (q.w * t3 + sigma(q.x * t2 - q.y * t1))};
}

/// The same where v.z = 0.
template <class T, class Sigma>
GradedVector<T> displacement_of_plane(const Sigma& sigma, const GradedQuaternion<T>& q,
                                      const T& inverse, const GradedVector<T>& v) {
  const T t1 = -(q.z * v.y), t2 = q.z * v.x, t3 = q.x * v.y - q.y * v.x;
  const T twice = inverse + inverse;
  return {twice * (q.w * t1 + q.y * t3 - sigma(q.z * t2)),
          twice * (q.w * t2 - q.x * t3 + sigma(q.z * t1)),
          twice * (q.w * t3 + sigma(q.x * t2 - q.y * t1))};
}

/// v moved by such a displacement.
template <class T, class Sigma>
GradedVector<T> moved(const Sigma& sigma, const GradedVector<T>& v, const GradedVector<T>& shift) {
  return {v.x + sigma(shift.x), v.y + sigma(shift.y), v.z + shift.z};
}

}  // namespace misalign::solver
