// One sheet of a mechanism: where its vertices lie on the flat sheet, and how far its joints are
// turned.
#pragma once

#include <vector>

#include "solver/kinematics/mechanism.hpp"
#include "solver/kinematics/rotation.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {

/// How far every joint is turned.
template <class T>
struct FoldState {
  std::vector<HalfAngle<T>> creases;
  std::vector<Quaternion<T>> balls;
};

/// The flat state: every joint at zero, and of the size that `mechanism` needs.
template <class T>
FoldState<T> flat_state(const Mechanism& mechanism) {
  return {std::vector<HalfAngle<T>>(mechanism.creases.size(), {T(1), T(0)}),
          std::vector<Quaternion<T>>(mechanism.balls.size(), {T(1), T(0), T(0), T(0)})};
}

/// The base folding with |pilot fold angle| = 2 * `pilot`: where every path starts.
/// `base_vertices_mm` are those of the correct sheet.
FoldState<double> base_state(const Mechanism& mechanism, const BaseFolding& folding,
                             const FlatVertices& base_vertices_mm, const HalfAngle<double>& pilot);

/// Where the vertices lie on the flat sheet, A1 at the origin, and the unit axes of its edges, in
/// panel widths: loops close to rounding of the coordinates, which must not grow with where a sheet
/// was drawn.
template <class T>
struct SheetGeometry {
  std::vector<T> x, y;            ///< per vertex
  std::vector<T> axis_x, axis_y;  ///< per edge, from a to b
};

/// Fills `geometry` (resized on first use) from flat coordinates in mm.
void place(const Mechanism& mechanism, const FlatVertices& vertices_mm,
           SheetGeometry<double>& geometry);

/// Turns every joint by its entry of `delta` (rad; one per unknown, in column order): creases about
/// their axis, ball joints by R <- exp(delta) R to second order.
template <class T>
void advance(const Mechanism& mechanism, const T* delta, FoldState<T>& state) {
  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    state.creases[i] = state.creases[i].turned(delta[mechanism.creases[i].column]);
  }
  for (std::size_t i = 0; i < mechanism.balls.size(); ++i) {
    const T* d = delta + mechanism.balls[i].column;
    const T half(0.5);
    state.balls[i] =
        (Quaternion<T>{T(1), half * d[0], half * d[1], half * d[2]} * state.balls[i]).normalized();
  }
}

}  // namespace misalign::solver
