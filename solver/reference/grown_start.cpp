#include "solver/reference/grown_start.hpp"

#include <algorithm>

#include "solver/linear/newton.hpp"
#include "solver/reference/arc_length.hpp"

namespace misalign::solver {
namespace {

// Steps, as shares of the shifts.
constexpr double kLongestStep = 1.0 / 512, kShortestStep = 1e-8;

// Turns of a crease, over the pilot's half angle: none is as large in a step on one branch, nor in
// the shortest step at a limit point, where states change like the root of the step.
constexpr double kLongestTurn = 0.2, kTurnOfCrossing = 1e-6;

}  // namespace

GrownStart grow_start(const Mechanism& mechanism, const FoldState<double>& base_state,
                      const FlatVertices& base_vertices_mm, const FlatVertices& vertices_mm) {
  const double pilot_half_sine = base_state.creases[mechanism.pilot].s;
  const FlatVertices shifts_mm = vertices_mm - base_vertices_mm;
  Newton newton(mechanism);
  SheetGeometry<double> geometry;
  GrownStart start{PathEnd::stalled, 0, base_state};
  FoldState<double> next = base_state;
  int sign = 0;
  double step = kLongestStep;
  while (start.share < 1) {
    const double share = std::min(1.0, start.share + step);
    place(mechanism, base_vertices_mm + share * shifts_mm, geometry);
    next = start.state;
    const bool is_closed = newton.correct(geometry, next).end == Newton::StopReason::converged;
    const double turn = largest_half_sine(next, start.state) / pilot_half_sine;
    const int sign_here = newton.factors().determinant_sign();
    if (sign == 0) sign = sign_here;
    if (is_closed && sign_here == sign && turn <= kLongestTurn) {
      start.share = share;
      start.state = next;
      step = std::min(2 * step, kLongestStep);
      continue;
    }
    step *= 0.5;
    if (step >= kShortestStep) continue;
    if (!is_closed || turn > kTurnOfCrossing) start.end = PathEnd::fold_limit;
    return start;
  }
  start.end = PathEnd::end_reached;
  return start;
}

}  // namespace misalign::solver
