// Sheets and states of lanes: reads and writes single lanes, and selects lane by lane.
#pragma once

#include <cmath>

#include "solver/kinematics/fold_state.hpp"
#include "solver/kinematics/lane_math.hpp"

namespace misalign::solver {

/// A geometry of the size that `mechanism` needs, every vertex at the origin.
template <class T>
SheetGeometry<T> lane_geometry(const Mechanism& mechanism) {
  const std::size_t vertices = static_cast<std::size_t>(mechanism.vertices);
  SheetGeometry<T> geometry;
  geometry.x.assign(vertices, T(0));
  geometry.y.assign(vertices, T(0));
  geometry.axis_x.assign(mechanism.edges.size(), T(1));
  geometry.axis_y.assign(mechanism.edges.size(), T(0));
  return geometry;
}

/// Computes the axes of the creases from their vertices.
template <class T>
void turn_axes(const Mechanism& mechanism, SheetGeometry<T>& geometry) {
  using std::sqrt;
  for (const Crease& crease : mechanism.creases) {
    const T dx = geometry.x[crease.b] - geometry.x[crease.a];
    const T dy = geometry.y[crease.b] - geometry.y[crease.a];
    const T inverse = T(1) / sqrt(dx * dx + dy * dy);
    geometry.axis_x[crease.edge] = dx * inverse;
    geometry.axis_y[crease.edge] = dy * inverse;
  }
}

/// Sets vertices and crease axes of `between`, at `share` of the way from `base` to `sheet`.
template <class T>
void put_between(const Mechanism& mechanism, const SheetGeometry<T>& base,
                 const SheetGeometry<T>& sheet, const T& share, SheetGeometry<T>& between) {
  for (std::size_t v = 0; v < base.x.size(); ++v) {
    between.x[v] = base.x[v] + share * (sheet.x[v] - base.x[v]);
    between.y[v] = base.y[v] + share * (sheet.y[v] - base.y[v]);
  }
  turn_axes(mechanism, between);
}

/// `b` in the lanes where `choice` is positive, else `a`.
template <class T>
void replace(const T& choice, const FoldState<T>& b, FoldState<T>& a) {
  const auto chosen = choice > T(0);
  for (std::size_t k = 0; k < a.creases.size(); ++k) {
    a.creases[k] = {select(chosen, b.creases[k].c, a.creases[k].c),
                    select(chosen, b.creases[k].s, a.creases[k].s)};
  }
  for (std::size_t k = 0; k < a.balls.size(); ++k) {
    const Quaternion<T>&p = a.balls[k], &q = b.balls[k];
    a.balls[k] = {select(chosen, q.w, p.w), select(chosen, q.x, p.x), select(chosen, q.y, p.y),
                  select(chosen, q.z, p.z)};
  }
}

template <class T>
void put_lane(const SheetGeometry<double>& from, SheetGeometry<T>& to, int i) {
  for (std::size_t v = 0; v < from.x.size(); ++v) {
    lane(to.x[v], i) = from.x[v];
    lane(to.y[v], i) = from.y[v];
  }
  for (std::size_t e = 0; e < from.axis_x.size(); ++e) {
    lane(to.axis_x[e], i) = from.axis_x[e];
    lane(to.axis_y[e], i) = from.axis_y[e];
  }
}

/// A sheet's vertices in every lane, as `place` has them; `turn_axes` sets axes once it is shifted.
template <class T>
SheetGeometry<T> in_all_lanes(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
  SheetGeometry<T> sheet = lane_geometry<T>(mechanism);
  const double* const mm = vertices_mm.data();
  const auto widths = [&](double from_first_mm) {
    return T(static_cast<Scalar<T>>(from_first_mm / mechanism.panel_width_mm));
  };
  for (int v = 0; v < mechanism.vertices; ++v) {
    sheet.x[v] = widths(mm[2 * v] - mm[0]);
    sheet.y[v] = widths(mm[2 * v + 1] - mm[1]);
  }
  return sheet;
}

template <class T>
void put_lane(const FoldState<double>& from, FoldState<T>& to, int i) {
  for (std::size_t k = 0; k < from.creases.size(); ++k) {
    lane(to.creases[k].c, i) = static_cast<Scalar<T>>(from.creases[k].c);
    lane(to.creases[k].s, i) = static_cast<Scalar<T>>(from.creases[k].s);
  }
  for (std::size_t k = 0; k < from.balls.size(); ++k) {
    lane(to.balls[k].w, i) = static_cast<Scalar<T>>(from.balls[k].w);
    lane(to.balls[k].x, i) = static_cast<Scalar<T>>(from.balls[k].x);
    lane(to.balls[k].y, i) = static_cast<Scalar<T>>(from.balls[k].y);
    lane(to.balls[k].z, i) = static_cast<Scalar<T>>(from.balls[k].z);
  }
}

template <class T>
void copy_lane(const FoldState<T>& from, int i, FoldState<double>& to) {
  for (std::size_t k = 0; k < to.creases.size(); ++k) {
    to.creases[k] = {lane(from.creases[k].c, i), lane(from.creases[k].s, i)};
  }
  for (std::size_t k = 0; k < to.balls.size(); ++k) {
    const Quaternion<T>& q = from.balls[k];
    to.balls[k] = {lane(q.w, i), lane(q.x, i), lane(q.y, i), lane(q.z, i)};
  }
}

}  // namespace misalign::solver
