#include "solver/linear/pivot_order.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <random>
#include <span>

#include "solver/linear/active_matrix.hpp"
#include "solver/linear/dissection.hpp"
#include "solver/linear/pivoted_jacobian.hpp"
#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {
namespace {

// Angles at which pivots are chosen and tried out, of 180 degrees, in proportion if the base
// folding ends earlier. Pivots are chosen on the base folding itself, where every loop closes: some
// minors vanish on closed states only (on 28 x 28 a pivot went from 1e-5 to 6e-10 and 2e-13 as
// Newton converged). A pivot that is large on the closed base is large near it, by continuity.
using Angles = std::array<double, kPivotStates>;
constexpr Angles kPlanned_deg = {1, 5, 20, 60, 100, 130, 150, 165, 175, 178};
constexpr Angles kTried_deg = {2, 10, 40, 80, 115, 140, 155, 160, 170, 177};
// Smallest share that a pivot has of its column's largest entry, at every state, unless no entry
// reaches it: multipliers stay below its inverse. A smaller share leaves more choice, hence costs
// fewer operations.
constexpr double kPivotThresholds[] = {0.0003, 0.001, 0.003, 0.01};

// Large sheets have others. More minors vanish at 90 degrees on the base, where sine and cosine are
// equal: unshifted paths of 16 x 16 and 20 x 20 stalled there. Many orders fail at it, so there are
// more thresholds to choose from. Unshifted paths of small sheets get beyond; their orders, and so
// the bits of their campaigns, stay as they are.
constexpr Angles kTriedOfLarge_deg = {2, 10, 40, 90, 115, 140, 155, 160, 170, 177};
constexpr double kPivotThresholdsOfLarge[] = {0.0003, 0.0004, 0.0006, 0.0008, 0.001,
                                              0.002,  0.003,  0.004,  0.01};

// Largest backward error of the trial, |J x - b| / (|J| |x| + |b|) by largest entries and row sums.
// A correction is off by at most this times the condition number: at 1 degree 1.6e5 (6 x 6) to
// 3.1e7 (28 x 28), at 60 a fiftieth and at 170 a twentieth of that. With three digits or more in
// each correction Newton converges as with dense factors.
constexpr double kLargestBackwardError = 1e-11;

// Distance of the trial's misaligned states from the base folding.
constexpr double kOffBase = 0.05;

// The Jacobian's values with the pilot at these angles, on the base folding, or up to the share
// `off` from it: every joint towards flat or closed, vertices by a tenth of it in panel widths. The
// C++ standard fixes the generator's sequence, so that the plan is the same on every machine.
std::vector<PivotValues> jacobians(const Mechanism& mechanism, const BaseFolding& folding,
                                   const FlatVertices& base_vertices_mm, const Angles& angles_deg,
                                   double off) {
  std::mt19937 generator(1);
  const auto random = [&] { return off * (static_cast<double>(generator()) / 2147483648.0 - 1.0); };
  FlatVertices vertices_mm = base_vertices_mm;
  for (Eigen::Index k = 0; k < vertices_mm.size(); ++k) {
    vertices_mm.data()[k] += 0.1 * mechanism.panel_width_mm * random();
  }
  SheetGeometry<double> geometry;
  place(mechanism, vertices_mm, geometry);
  std::vector<PivotValues> jacobians(jacobian_entries(mechanism).size());
  std::vector<double> residual(mechanism.equations), turn(mechanism.unknowns);
  std::vector<double> values(jacobians.size());
  for (int s = 0; s < kPivotStates; ++s) {
    const HalfAngle<double> pilot = half_angle_of_deg(angles_deg[s] / 180 * folding.end_deg());
    FoldState<double> state = base_state(mechanism, folding, base_vertices_mm, pilot);
    for (double& angle : turn) angle = pilot.s * pilot.c * random();
    advance(mechanism, turn.data(), state);
    evaluate(mechanism, geometry, state, residual.data(), values.data());
    for (std::size_t e = 0; e < values.size(); ++e) jacobians[e][s] = values[e];
  }
  return jacobians;
}

// Raises `norm` to |value| if that is larger, to infinity if it is not a number.
void take_larger(double& norm, double value) {
  if (!(std::abs(value) <= norm)) norm = std::isnan(value) ? HUGE_VAL : std::abs(value);
}

// The worst backward error of solutions for random right-hand sides, the pilot held.
double worst_backward_error(const Elimination& plan, const std::vector<JacobianEntry>& entries,
                            const std::vector<PivotValues>& jacobians) {
  std::mt19937 generator(2);
  const std::size_t n = static_cast<std::size_t>(plan.equations);
  std::vector<double> rhs(n), rest(n), row_sums(n), y(n + 1), x(n + 1);
  const auto largest = [](const std::vector<double>& values) {
    double norm = 0;
    for (const double value : values) take_larger(norm, value);
    return norm;
  };
  SparseLu<double> lu(plan);
  double worst = 0;
  for (int s = 0; s < kPivotStates; ++s) {
    auto entry = lu.entries();
    for (const PivotValues& values : jacobians) *entry++ = values[s];
    lu.factorize();
    for (double& value : rhs) value = static_cast<double>(generator()) / 2147483648.0 - 1.0;
    lu.forward(rhs.data(), y.data());
    lu.backward_held(y.data(), x.data());
    rest = rhs;
    row_sums.assign(n, 0);
    for (std::size_t e = 0; e < entries.size(); ++e) {
      rest[entries[e].row] -= jacobians[e][s] * x[entries[e].column];
      row_sums[entries[e].row] += std::abs(jacobians[e][s]);
    }
    take_larger(worst, largest(rest) / (largest(row_sums) * largest(x) + largest(rhs)));
  }
  return worst;
}

// Relative difference below which the first of two merits counts: rounding must not choose.
constexpr double kEqualMerit = 1e-9;

// Returns a crease far from the pilot and fast near the folded end, where the rates of fold angles
// are inverse to their tangents' ratios to the pilot's.
int partner_of_pilot(const Mechanism& mechanism, const BaseFolding& folding,
                     const FlatVertices& vertices_mm) {
  const auto middle = [&](const Crease& crease) -> Eigen::Vector2d {
    return 0.5 * (vertices_mm.col(crease.a) + vertices_mm.col(crease.b));
  };
  assert(folding.end_deg() > 0 && folding.end_deg() <= 180);
  const auto angles = folding.fold_angles(half_angle_of_deg(0.5 * folding.end_deg()));
  const Crease& pilot = mechanism.creases[mechanism.pilot];
  double most = 0;
  int partner = -1;
  for (const Crease& crease : mechanism.creases) {
    const HalfAngle<double>& rho = angles[crease.edge];
    const double merit = (middle(crease) - middle(pilot)).norm() * rho.c / std::abs(rho.s);
    if (merit <= most * (1 + kEqualMerit)) continue;
    most = merit;
    partner = crease.column;
  }
  return partner;
}

Elimination plan_with(double first_threshold, const std::vector<JacobianEntry>& entries,
                      const std::vector<PivotValues>& jacobians,
                      const std::vector<std::vector<int>>& parts, int equations, int partner) {
  ActiveMatrix active(entries, jacobians, equations);
  std::vector<int> row_of, column_of;
  std::vector<bool> row_done(equations, false);
  std::vector<int> waiting;  // columns of the parts so far that have no pivot yet
  const auto eliminate_waiting = [&](double threshold) {
    for (;;) {
      const ActiveMatrix::Place pivot = active.choose(waiting, threshold);
      if (pivot.row < 0) return;
      active.eliminate(pivot);
      row_of.push_back(pivot.row);
      column_of.push_back(pivot.column);
      row_done[pivot.row] = true;
      std::erase(waiting, pivot.column);
    }
  };
  for (const std::vector<int>& part : parts) {
    for (const int column : part) {
      if (column != partner && column != equations) waiting.push_back(column);
    }
    eliminate_waiting(first_threshold);
  }
  for (double threshold = first_threshold; !waiting.empty(); threshold *= 0.1) {
    assert(threshold > 1e-15 && "the mechanism has more than one degree of freedom");
    eliminate_waiting(threshold);
  }
  assert(std::ssize(row_of) == equations - 1);  // the partner's row is left
  row_of.push_back(
      static_cast<int>(std::find(row_done.begin(), row_done.end(), false) - row_done.begin()));
  column_of.push_back(partner);
  column_of.push_back(equations);
  return eliminate_in_order(entries, row_of, column_of);
}

}  // namespace

Elimination plan_elimination(const Mechanism& mechanism, const BaseFolding& folding,
                             const FlatVertices& base_vertices_mm) {
  const auto jacobians_at = [&](const Angles& angles_deg, double off) {
    return jacobians(mechanism, folding, base_vertices_mm, angles_deg, off);
  };
  const std::vector<JacobianEntry> entries = jacobian_entries(mechanism);
  const std::vector<PivotValues> planned = jacobians_at(kPlanned_deg, 0);
  const bool is_large = PivotedJacobian::is_sparse(mechanism);
  const Angles& tried_deg = is_large ? kTriedOfLarge_deg : kTried_deg;
  const auto thresholds = is_large ? std::span<const double>(kPivotThresholdsOfLarge)
                                   : std::span<const double>(kPivotThresholds);
  const std::vector<PivotValues> closed = jacobians_at(tried_deg, 0);
  const std::vector<PivotValues> misaligned = jacobians_at(tried_deg, kOffBase);
  const auto parts = dissect(mechanism, base_vertices_mm);
  const int partner = partner_of_pilot(mechanism, folding, base_vertices_mm);
  assert(partner >= 0 && partner < mechanism.equations);
  Elimination best{};
  double least_error = HUGE_VAL;
  for (const double threshold : thresholds) {
    Elimination plan = plan_with(threshold, entries, planned, parts, mechanism.equations, partner);
    const double error = std::max(worst_backward_error(plan, entries, closed),
                                  worst_backward_error(plan, entries, misaligned));
    if (best.equations == 0 || error < least_error) {
      best = std::move(plan);
      least_error = error;
    }
    if (least_error <= kLargestBackwardError) break;
  }
  return best;
}

}  // namespace misalign::solver
