#include "solver/reference/grown_start.hpp"

#include "solver/linear/newton.hpp"
#include "solver/reference/arc_length.hpp"

namespace misalign::solver {
namespace {

// Of the pilot's own half angle, what no crease turns by in a step on its own branch.
constexpr double kLongestTurnShare = 0.2;

}  // namespace

GrownStart grow_start(const Mechanism& mechanism, const FoldState<double>& base_state,
                      const FlatVertices& base_vertices_mm, const FlatVertices& vertices_mm,
                      int steps) {
  const double longest_half_sine = kLongestTurnShare * base_state.creases[mechanism.pilot].s;
  Newton newton(mechanism);
  SheetGeometry<double> geometry;
  GrownStart start{0, base_state};
  int sign = 0;
  for (int k = 0; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    place(mechanism, base_vertices_mm + share * (vertices_mm - base_vertices_mm), geometry);
    FoldState<double> next = start.state;
    const bool closed = newton.correct(geometry, next).end == NewtonEnd::converged;
    const int sign_here = newton.factors().determinant_sign();
    if (sign == 0) sign = sign_here;
    // A turn of the branch: no solution near, one on its other half, or one far off.
    if (!closed || sign_here != sign || largest_half_sine(next, start.state) > longest_half_sine) {
      return start;
    }
    start = {share, next};
  }
  return start;
}

}  // namespace misalign::solver
