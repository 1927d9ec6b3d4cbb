// Lengths of the holes' diagonals: flat, and in a folded state.
#pragma once

#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {

template <class T>
T distance(const Vec3<T>& p, const Vec3<T>& q) {
  using std::sqrt;
  const Vec3<T> d = p - q;
  return sqrt(dot(d, d));
}

/// Flat lengths in panel widths, one per diagonal.
template <class T>
void flat_lengths(const Mechanism& mechanism, const SheetGeometry<T>& geometry, T* lengths) {
  for (const Diagonal& diagonal : mechanism.diagonals) {
    *lengths++ = distance(flat_point(geometry, diagonal.from), flat_point(geometry, diagonal.to));
  }
}

/// The corners of a hole in the frame of the facet where its loop begins. Where joints have play a
/// corner is that of the facet from which the loop comes to it.
template <class T, class Geometry>
std::array<Vec3<T>, 4> corner_points(const Mechanism& mechanism, const Geometry& geometry,
                                     const FoldState<T>& state, const Loop& loop) {
  std::array<Vec3<T>, 4> points{};
  Pose<T> pose = Pose<T>::identity();
  int next = 0;
  for (int corner = 0; corner < 4; ++corner) {
    for (; next < loop.arrival[corner]; ++next) {
      const Passage& passage = loop.passages[next];
      displace_before(geometry, passage, pose);
      pose = pose.then_rotate(passage_rotation(mechanism, geometry, state, passage),
                              flat_point(geometry, passage.vertex));
      displace_after(geometry, passage, pose);
    }
    points[corner] = pose * flat_point(geometry, loop.corners[corner]);
  }
  return points;
}

/// Folded lengths in panel widths, one per diagonal, from the corners that each hole's loop passes.
template <class T, class Geometry>
void folded_lengths(const Mechanism& mechanism, const Geometry& geometry, const FoldState<T>& state,
                    T* lengths) {
  int known_loop = -1;
  std::array<Vec3<T>, 4> corners{};
  for (const Diagonal& diagonal : mechanism.diagonals) {
    if (diagonal.loop != known_loop) {
      known_loop = diagonal.loop;
      corners = corner_points(mechanism, geometry, state, mechanism.loops[known_loop]);
    }
    *lengths++ = distance(corners[diagonal.from_corner], corners[diagonal.to_corner]);
  }
}

/// Folded lengths, and their rates of change (panel widths per unit of `rates`) while every unknown
/// changes at its rate: each joint moves what comes after it by a screw. `misfit` (one per
/// equation) becomes the Jacobian times `rates`: 0 along a folding path.
template <class T, class Geometry>
void folded_lengths_and_slopes(const Mechanism& mechanism, const Geometry& geometry,
                               const FoldState<T>& state, const T* rates, T* lengths, T* slopes,
                               T* misfit) {
  const Diagonal* diagonal = mechanism.diagonals.data();
  for (const Loop& loop : mechanism.loops) {
    std::array<Vec3<T>, 4> corners{}, velocities{};
    Pose<T> pose = Pose<T>::identity();
    Vec3<T> spin{T(0), T(0), T(0)}, drift = spin;  // a point p moves by spin x p + drift
    const int passages = static_cast<int>(loop.passages.size());
    int corner = 0;
    for (int next = 0;; ++next) {
      for (; loop.hole >= 0 && corner < 4 && loop.arrival[corner] == next; ++corner) {
        corners[corner] = pose * flat_point(geometry, loop.corners[corner]);
        velocities[corner] = cross(spin, corners[corner]) + drift;
      }
      if (next == passages) break;
      const Passage& passage = loop.passages[next];
      displace_before(geometry, passage, pose);
      const Pose<T> before = pose;
      pose = pose.then_rotate(passage_rotation(mechanism, geometry, state, passage),
                              flat_point(geometry, passage.vertex));
      detail::LoopScrews<T> screws;
      detail::gather(mechanism, geometry, passage, before, pose, screws);
      const T* rate = rates + mechanism.first_column(passage);
      for (int k = 0; k < screws.count; ++k) {
        const Vec3<T> turn = rate[k] * screws.axis[k];
        spin = spin + turn;
        drift = drift - cross(turn, screws.point[k]);
      }
      displace_after(geometry, passage, pose);
    }
    for (const T& rate : {spin.x, spin.y, spin.z}) *misfit++ = rate;
    if (loop.hole < 0) continue;
    for (const T& rate : {drift.x, drift.y, drift.z}) *misfit++ = rate;
    for (int k = 0; k < 2; ++k, ++diagonal) {
      const Vec3<T> along = corners[diagonal->from_corner] - corners[diagonal->to_corner];
      const Vec3<T> apart = velocities[diagonal->from_corner] - velocities[diagonal->to_corner];
      const T length = distance(corners[diagonal->from_corner], corners[diagonal->to_corner]);
      *lengths++ = length;
      *slopes++ = dot(along, apart) / length;
    }
  }
}

}  // namespace misalign::solver
