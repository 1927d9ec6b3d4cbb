// Evaluates loop closure, equations (3.1)-(3.7), in one flat frame: every joint is a rotation that
// keeps a point of the flat sheet in place, and their product round a loop must be the identity.
// One template for double, for lanes and for dual numbers.
//
// Let T_i be the product of the joints before passage i, and R, t the rotation and translation of
// the whole loop (t displaces A1, the origin, in panel widths). Then
//   residual   vee(R - R^T) / 2   and, round a hole, t
//   Jacobian   a joint with axis w (turned by T_i) through c (moved by T_i) moves the loop by the
//              screw dR = [w]x R, dt = w x (t - c), hence d vee = (tr(R) I - R) w / 2.
// Closed means R = I in all nine entries: the residual alone vanishes at a half turn too. Joints
// with play also displace what follows them: a policy of the geometry (LooseSheet).
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// Place of one value of the Jacobian in the equations x unknowns matrix.
struct JacobianEntry {
  int row, column;
};

/// Rotation on crossing a crease with axis u in the sheet: by -rho about +-u, written out.
template <class T>
Mat3<T> crease_rotation(const HalfAngle<T>& rho, const T& ux, const T& uy, int sense) {
  const T s2 = rho.s * rho.s + rho.s * rho.s;
  const T cs2 = sense > 0 ? -(rho.c * rho.s + rho.c * rho.s) : rho.c * rho.s + rho.c * rho.s;
  const T xy = s2 * ux * uy;
  return {{T(1) - s2 * uy * uy, xy, -(cs2 * uy)},
          {xy, T(1) - s2 * ux * ux, cs2 * ux},
          {cs2 * uy, -(cs2 * ux), T(1) - s2}};
}

template <class T>
Mat3<T> passage_rotation(const Mechanism& mechanism, const SheetGeometry<T>& geometry,
                         const FoldState<T>& state, const Passage& passage) {
  if (passage.ball) {
    const Quaternion<T>& q = state.balls[passage.joint];
    return passage.sense > 0 ? q.matrix() : q.conjugate().matrix();
  }
  const int edge = mechanism.creases[passage.joint].edge;
  return crease_rotation(state.creases[passage.joint], geometry.axis_x[edge], geometry.axis_y[edge],
                         passage.sense);
}

template <class T>
Vec3<T> flat_point(const SheetGeometry<T>& geometry, int vertex) {
  return {geometry.x[vertex], geometry.y[vertex], T(0)};
}

/// A sheet whose joints have play: besides turning, each joint displaces what follows it by a fixed
/// motion, given for a passage of sense +1 in the frame of the facet that it leaves. The joints of
/// any other geometry only turn.
template <class Geometry>
concept HasPlay = requires(const Geometry& geometry, const Passage& passage) {
  geometry.displacement(passage);
};

/// A passage is `displace_before`, the joint's rotation, `displace_after`.
template <class T, class Geometry>
void displace_before([[maybe_unused]] const Geometry& geometry,
                     [[maybe_unused]] const Passage& passage, [[maybe_unused]] Pose<T>& pose) {
  if constexpr (HasPlay<Geometry>) {
    if (passage.sense > 0) pose = pose.then(geometry.displacement(passage));
  }
}
template <class T, class Geometry>
void displace_after([[maybe_unused]] const Geometry& geometry,
                    [[maybe_unused]] const Passage& passage, [[maybe_unused]] Pose<T>& pose) {
  if constexpr (HasPlay<Geometry>) {
    if (passage.sense < 0) pose = pose.then(geometry.displacement(passage).inverse());
  }
}

/// Largest of the nine entries of |R - I| and, for six equations, of the three of |t|.
template <class T>
T open_by(const Pose<T>& loop, int rows) {
  using std::abs;
  using std::max;
  const Mat3<T>& r = loop.rotation;
  const T rotation = max(max(max(abs(r.cx.x - T(1)), abs(r.cy.y - T(1))), abs(r.cz.z - T(1))),
                         max(max(max(abs(r.cx.y), abs(r.cx.z)), max(abs(r.cy.x), abs(r.cy.z))),
                             max(abs(r.cz.x), abs(r.cz.y))));
  if (rows == 3) return rotation;
  const Vec3<T>& t = loop.translation;
  return max(rotation, max(max(abs(t.x), abs(t.y)), abs(t.z)));
}

namespace detail {

// The screws of one loop, gathered on the way round; at most four ball joints or eight creases.
template <class T>
struct LoopScrews {
  std::array<Vec3<T>, 12> axis, point;
  int count = 0;
  void add(const Vec3<T>& w, const Vec3<T>& c) {
    axis[count] = w;
    point[count] = c;
    ++count;
  }
};

// Gathers the screws by which a unit change of each of the passage's unknowns moves what follows
// it.
template <class T>
void gather(const Mechanism& mechanism, const SheetGeometry<T>& geometry, const Passage& passage,
            const Pose<T>& before, const Pose<T>& after, LoopScrews<T>& screws) {
  const Vec3<T> c = before * flat_point(geometry, passage.vertex);
  if (passage.ball) {
    // R <- exp(d) R, or its inverse R^T exp(-d) when passed the other way.
    const Mat3<T>& frame = passage.sense > 0 ? before.rotation : after.rotation;
    const T sign = passage.sense > 0 ? T(1) : T(-1);
    screws.add(sign * frame.cx, c);
    screws.add(sign * frame.cy, c);
    screws.add(sign * frame.cz, c);
  } else {
    const int edge = mechanism.creases[passage.joint].edge;
    const T sign = passage.sense > 0 ? T(-1) : T(1);
    screws.add(sign * (geometry.axis_x[edge] * before.rotation.cx +
                       geometry.axis_y[edge] * before.rotation.cy),
               c);
  }
}

template <class T, class Values>
Values write_columns(const Pose<T>& loop, int rows, const LoopScrews<T>& screws, Values values) {
  const T half(0.5);
  const T trace = loop.rotation.trace();
  for (int k = 0; k < screws.count; ++k) {
    const Vec3<T>& w = screws.axis[k];
    const Vec3<T> vee = half * (trace * w - loop.rotation * w);
    *values++ = vee.x;
    *values++ = vee.y;
    *values++ = vee.z;
    if (rows == 3) continue;
    const Vec3<T> dt = cross(w, loop.translation - screws.point[k]);
    *values++ = dt.x;
    *values++ = dt.y;
    *values++ = dt.z;
  }
  return values;
}

}  // namespace detail

/// The places of the values that `evaluate` writes, in its order: loop by loop, passage by passage,
/// unknown by unknown, row by row. Each place occurs once.
std::vector<JacobianEntry> jacobian_entries(const Mechanism& mechanism);

/// Writes the residual (one per equation) and the Jacobian's structural nonzeros, these to the
/// output iterator `values` unless that is nullptr. Returns the opening of the worst loop (panel
/// widths, radians), which is compared with the closure tolerance. Allocates nothing.
template <class T, class Geometry, class Values>
T evaluate(const Mechanism& mechanism, const Geometry& geometry, const FoldState<T>& state,
           T* residual, Values values) {
  constexpr bool kWithJacobian = !std::is_null_pointer_v<Values>;
  using std::max;
  T worst(0);
  const T half(0.5);
  for (const Loop& loop : mechanism.loops) {
    [[maybe_unused]] detail::LoopScrews<T> screws;
    Pose<T> pose = Pose<T>::identity();
    bool first = true;
    for (const Passage& passage : loop.passages) {
      displace_before(geometry, passage, pose);
      const Pose<T> before = pose;
      const Mat3<T> turn = passage_rotation(mechanism, geometry, state, passage);
      const Vec3<T> fixed = flat_point(geometry, passage.vertex);
      pose = first && !HasPlay<Geometry> ? Pose<T>::rotation_about(turn, fixed)
                                         : pose.then_rotate(turn, fixed);
      first = false;
      if constexpr (kWithJacobian) {
        detail::gather(mechanism, geometry, passage, before, pose, screws);
      }
      displace_after(geometry, passage, pose);
    }
    const Mat3<T>& r = pose.rotation;
    T* row = residual + loop.first_row;
    row[0] = half * (r.cy.z - r.cz.y);
    row[1] = half * (r.cz.x - r.cx.z);
    row[2] = half * (r.cx.y - r.cy.x);
    if (loop.rows == 6) {
      row[3] = pose.translation.x;
      row[4] = pose.translation.y;
      row[5] = pose.translation.z;
    }
    worst = max(worst, open_by(pose, loop.rows));
    if constexpr (kWithJacobian) values = detail::write_columns(pose, loop.rows, screws, values);
  }
  return worst;
}

}  // namespace misalign::solver
