// Holds one sheet of a mechanism: the places of its vertices on the flat sheet, and the rotations
// of its joints.
#pragma once

#include <vector>

#include "solver/kinematics/mechanism.hpp"
#include "solver/kinematics/rotation.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {

/// Rotations of all joints.
template <class T>
struct FoldState {
  std::vector<HalfAngle<T>> creases;
  std::vector<Quaternion<T>> balls;
};

/// The flat state of `mechanism`: every joint at zero.
template <class T>
FoldState<T> flat_state(const Mechanism& mechanism) {
  return {std::vector<HalfAngle<T>>(mechanism.creases.size(), {T(1), T(0)}),
          std::vector<Quaternion<T>>(mechanism.balls.size(), {T(1), T(0), T(0), T(0)})};
}

/// The base folding with |pilot fold angle| = 2 * `pilot`: where every path starts.
/// `base_vertices_mm` are those of the correct sheet.
FoldState<double> base_state(const Mechanism& mechanism, const BaseFolding& folding,
                             const FlatVertices& base_vertices_mm, const HalfAngle<double>& pilot);

/// A state near flat with every joint turned `share` times as far: near the path there, since its
/// fold angles are in proportion to the pilot's to second order.
FoldState<double> in_proportion(const FoldState<double>& state, double share);

/// Vertices of the flat sheet in panel widths, and unit axes of its edges. A1 is the origin, since
/// loops close up to the rounding of coordinates, which must not depend on where a sheet was drawn.
template <class T>
struct SheetGeometry {
  std::vector<T> x, y;            ///< per vertex
  std::vector<T> axis_x, axis_y;  ///< per edge, from a to b
};

/// Fills `geometry` (resized on first use) from flat coordinates in mm.
void place(const Mechanism& mechanism, const FlatVertices& vertices_mm,
           SheetGeometry<double>& geometry);

/// Lengths of the creases, mm.
void find_crease_lengths(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                         std::vector<double>& creases_mm);

/// Sum over all creases of length times |fold angle|, mm: the friction of 1 N mm per mm does this
/// work (N mm) from flat if no crease turns back.
double turning_mm(const std::vector<double>& creases_mm,
                  const std::vector<HalfAngle<double>>& creases);

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
