// Measures the holes' diagonals, flat and folded: the lengths of their springs from end to end.
#pragma once

#include "solver/kinematics/lane_math.hpp"
#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {

template <class T>
T norm(const Vec3<T>& v) {
  using std::sqrt;
  return sqrt(dot(v, v));
}

template <class T>
T distance(const Vec3<T>& p, const Vec3<T>& q) {
  return norm(p - q);
}

namespace detail {

/// The corner of a panel that carries the end of a spring, on the flat sheet.
template <class T>
struct CarrierCorner {
  Vec3<T> vertex, to_before, to_after;  ///< units along its edges
  T before_length, after_length;        ///< panel widths
  const Eigen::Vector3d& place_mm;

  CarrierCorner(const SheetGeometry<T>& geometry, int at, const Loop::Carrier& carrier)
      : vertex(flat_point(geometry, at)),
        to_before(flat_point(geometry, carrier.before) - vertex),
        to_after(flat_point(geometry, carrier.after) - vertex),
        before_length(norm(to_before)),
        after_length(norm(to_after)),
        place_mm(carrier.place_mm) {
    to_before = (T(1) / before_length) * to_before;
    to_after = (T(1) / after_length) * to_after;
  }
  /// Not of unit length.
  Vec3<T> bisector() const { return to_before + to_after; }
  /// Place of the spring's end: along the bisector, to its left, up.
  Vec3<T> place(const Mechanism& mechanism) const {
    const auto in_widths = [&](double mm) { return constant<T>(mm / mechanism.panel_width_mm); };
    return {in_widths(place_mm.x()), in_widths(place_mm.y()), in_widths(place_mm.z())};
  }
};

}  // namespace detail

/// The spring's end at a corner of a hole on the flat sheet, panel widths.
template <class T>
Vec3<T> spring_end(const Mechanism& mechanism, const SheetGeometry<T>& geometry, const Loop& loop,
                   int corner) {
  if (mechanism.springs.at_vertices()) return flat_point(geometry, loop.corners[corner]);
  const detail::CarrierCorner<T> panel(geometry, loop.corners[corner], loop.carriers[corner]);
  const Vec3<T> place = panel.place(mechanism), along = panel.bisector();
  const T length = norm(along);
  Vec3<T> end = panel.vertex + (place.x / length) * along;
  end = end + (place.y / length) * Vec3<T>{-along.y, along.x, T(0)};
  end.z = end.z + place.z;
  return end;
}

/// Adds d (force . end) / d vertex to `gradient`: a force on that end (x, y in the flat sheet)
/// carried to the vertices, x and y of each in turn.
template <class T>
void add_end(const Mechanism& mechanism, const SheetGeometry<T>& geometry, const Loop& loop,
             int corner, const Vec3<T>& force, T* gradient) {
  const auto add = [&](int vertex, const Vec3<T>& change) {
    gradient[2 * vertex] = gradient[2 * vertex] + change.x;
    gradient[2 * vertex + 1] = gradient[2 * vertex + 1] + change.y;
  };
  add(loop.corners[corner], force);
  if (mechanism.springs.at_vertices()) return;
  const auto across = [](const Vec3<T>& v, const Vec3<T>& unit) { return v - dot(unit, v) * unit; };
  const detail::CarrierCorner<T> panel(geometry, loop.corners[corner], loop.carriers[corner]);
  const Vec3<T> place = panel.place(mechanism), turned{force.y, -force.x, T(0)};
  const T length = norm(panel.bisector());
  const Vec3<T> unit = (T(1) / length) * panel.bisector();
  const Vec3<T> on_units =
      (place.x / length) * across(force, unit) + (place.y / length) * across(turned, unit);
  const Vec3<T> before = (T(1) / panel.before_length) * across(on_units, panel.to_before);
  const Vec3<T> after = (T(1) / panel.after_length) * across(on_units, panel.to_after);
  add(loop.carriers[corner].before, before);
  add(loop.carriers[corner].after, after);
  add(loop.corners[corner], T(-1) * (before + after));
}

/// Flat lengths in panel widths, one per diagonal.
template <class T>
void flat_lengths(const Mechanism& mechanism, const SheetGeometry<T>& geometry, T* lengths) {
  for (const Diagonal& diagonal : mechanism.diagonals) {
    const Loop& loop = mechanism.loops[diagonal.loop];
    *lengths++ = distance(spring_end(mechanism, geometry, loop, diagonal.from_corner),
                          spring_end(mechanism, geometry, loop, diagonal.to_corner));
  }
}

/// Adds `share` times the derivatives of a diagonal's flat length to `gradient` (x and y of each
/// vertex in turn).
template <class T>
void add_flat_length(const Mechanism& mechanism, const SheetGeometry<T>& geometry,
                     const Diagonal& diagonal, const T& share, T* gradient) {
  const Loop& loop = mechanism.loops[diagonal.loop];
  const Vec3<T> along = spring_end(mechanism, geometry, loop, diagonal.from_corner) -
                        spring_end(mechanism, geometry, loop, diagonal.to_corner);
  const Vec3<T> pull = (share / norm(along)) * along;
  add_end(mechanism, geometry, loop, diagonal.from_corner, pull, gradient);
  add_end(mechanism, geometry, loop, diagonal.to_corner, T(-1) * pull, gradient);
}

/// Ends of a hole's springs, in the frame of the facet where its loop begins. If joints have play,
/// a corner is that of the facet from which the loop arrives.
template <class T, class Geometry>
std::array<Vec3<T>, 4> ends_of_springs(const Mechanism& mechanism, const Geometry& geometry,
                                       const FoldState<T>& state, const Loop& loop) {
  std::array<Vec3<T>, 4> points{};
  Pose<T> pose = Pose<T>::identity();
  int next = 0;
  for (int corner = 0; corner < 4; ++corner) {
    for (; next < loop.carriers[corner].arrival; ++next) {
      const Passage& passage = loop.passages[next];
      displace_before(geometry, passage, pose);
      pose = pose.then_rotate(passage_rotation(mechanism, geometry, state, passage),
                              flat_point(geometry, passage.vertex));
      displace_after(geometry, passage, pose);
    }
    points[corner] = pose * spring_end(mechanism, geometry, loop, corner);
  }
  return points;
}

/// Folded lengths in panel widths, one per diagonal, from the ends that each hole's loop passes.
template <class T, class Geometry>
void folded_lengths(const Mechanism& mechanism, const Geometry& geometry, const FoldState<T>& state,
                    T* lengths) {
  int known_loop = -1;
  std::array<Vec3<T>, 4> ends{};
  for (const Diagonal& diagonal : mechanism.diagonals) {
    if (diagonal.loop != known_loop) {
      known_loop = diagonal.loop;
      ends = ends_of_springs(mechanism, geometry, state, mechanism.loops[known_loop]);
    }
    *lengths++ = distance(ends[diagonal.from_corner], ends[diagonal.to_corner]);
  }
}

/// Folded lengths, and their rates of change (panel widths per unit of `rates`) while every unknown
/// changes at its rate: each joint moves all parts after it by a screw. `misfit` (one per equation)
/// becomes the Jacobian times `rates`: 0 along a folding path.
template <class T, class Geometry>
void folded_lengths_and_slopes(const Mechanism& mechanism, const Geometry& geometry,
                               const FoldState<T>& state, const T* rates, T* lengths, T* slopes,
                               T* misfit) {
  const Diagonal* diagonal = mechanism.diagonals.data();
  for (const Loop& loop : mechanism.loops) {
    std::array<Vec3<T>, 4> ends{}, velocities{};
    Pose<T> pose = Pose<T>::identity();
    Vec3<T> spin{T(0), T(0), T(0)}, drift = spin;  // a point p moves by spin x p + drift
    const int passages = static_cast<int>(loop.passages.size());
    int corner = 0;
    for (int next = 0;; ++next) {
      for (; loop.hole >= 0 && corner < 4 && loop.carriers[corner].arrival == next; ++corner) {
        ends[corner] = pose * spring_end(mechanism, geometry, loop, corner);
        velocities[corner] = cross(spin, ends[corner]) + drift;
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
      const Vec3<T> along = ends[diagonal->from_corner] - ends[diagonal->to_corner];
      const Vec3<T> apart = velocities[diagonal->from_corner] - velocities[diagonal->to_corner];
      const T length = norm(along);
      *lengths++ = length;
      *slopes++ = dot(along, apart) / length;
    }
  }
}

}  // namespace misalign::solver
