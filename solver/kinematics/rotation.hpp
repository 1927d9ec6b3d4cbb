// Vectors, rotation matrices and unit quaternions over any scalar: double, a register of lanes, a
// dual number. They use only +, -, *, / and square roots, in the order written, so that a result
// does not depend on a compiler's or library's choice of instructions.
#pragma once

#include <cmath>

namespace misalign::solver {

template <class T>
struct Vec3 {
  T x, y, z;

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const T& k, const Vec3& a) { return {k * a.x, k * a.y, k * a.z}; }
};

template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A rotation matrix; the columns are the images of the axes.
template <class T>
struct Mat3 {
  Vec3<T> cx, cy, cz;

  static Mat3 identity() { return {{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}; }
  Mat3 transpose() const { return {{cx.x, cy.x, cz.x}, {cx.y, cy.y, cz.y}, {cx.z, cy.z, cz.z}}; }
  T trace() const { return cx.x + cy.y + cz.z; }

  friend Vec3<T> operator*(const Mat3& m, const Vec3<T>& v) {
    return {m.cx.x * v.x + m.cy.x * v.y + m.cz.x * v.z, m.cx.y * v.x + m.cy.y * v.y + m.cz.y * v.z,
            m.cx.z * v.x + m.cy.z * v.y + m.cz.z * v.z};
  }
  friend Mat3 operator*(const Mat3& a, const Mat3& b) { return {a * b.cx, a * b.cy, a * b.cz}; }
};

/// Unit quaternion: w = cos(half the angle), (x, y, z) = sin(half the angle) times the axis.
template <class T>
struct Quaternion {
  T w, x, y, z;

  Quaternion conjugate() const { return {w, -x, -y, -z}; }

  /// `*this` scaled back to length one.
  Quaternion normalized() const {
    using std::sqrt;
    const T scale = T(1) / sqrt(w * w + x * x + y * y + z * z);
    return {w * scale, x * scale, y * scale, z * scale};
  }

  Mat3<T> matrix() const {
    const T x2 = x + x, y2 = y + y, z2 = z + z;
    const T xx = x * x2, yy = y * y2, zz = z * z2;
    const T xy = x * y2, xz = x * z2, yz = y * z2;
    const T wx = w * x2, wy = w * y2, wz = w * z2;
    return {{T(1) - (yy + zz), xy + wz, xz - wy},
            {xy - wz, T(1) - (xx + zz), yz + wx},
            {xz + wy, yz - wx, T(1) - (xx + yy)}};
  }

  friend Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
};

/// A rigid motion: X_AB takes coordinates of B to those of A.
template <class T>
struct Pose {
  Mat3<T> rotation;
  Vec3<T> translation;

  static Pose identity() { return {Mat3<T>::identity(), {T(0), T(0), T(0)}}; }

  Vec3<T> operator*(const Vec3<T>& p) const { return rotation * p + translation; }

  /// A rotation that keeps the point `fixed` in place.
  static Pose rotation_about(const Mat3<T>& turn, const Vec3<T>& fixed) {
    return {turn, fixed - turn * fixed};
  }

  /// This motion followed, in its own frame, by a rotation that keeps the point `fixed` in place.
  Pose then_rotate(const Mat3<T>& turn, const Vec3<T>& fixed) const {
    return {rotation * turn, translation + rotation * (fixed - turn * fixed)};
  }

  /// This motion followed, in its own frame, by another.
  Pose then(const Pose& next) const {
    return {rotation * next.rotation, translation + rotation * next.translation};
  }
  Pose inverse() const {
    const Mat3<T> back = rotation.transpose();
    return {back, T(-1) * (back * translation)};
  }
};

}  // namespace misalign::solver
