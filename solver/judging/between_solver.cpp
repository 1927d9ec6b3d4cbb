#include "solver/judging/between_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "solver/continuation/lane_corrector.hpp"
#include "solver/linear/newton.hpp"
#include "solver/model/dense_state.hpp"

namespace misalign::solver {
namespace {

// An error of a cubic's rate in the middle counts an eighth: there the fifth derivative shows, and
// the fourth does not.
constexpr double kMiddlePerRate = 0.125;

// What a state may be away from its neighbours' mean (rad).
constexpr double kFarthestFromMean_rad = 0.2;

HalfAngle<double> between(const HalfAngle<double>& a, const HalfAngle<double>& b, double share) {
  return HalfAngle<double>{a.c + share * (b.c - a.c), a.s + share * (b.s - a.s)}.turned(0);
}

Quaternion<double> between(const Quaternion<double>& a, const Quaternion<double>& b, double share) {
  return Quaternion<double>{a.w + share * (b.w - a.w), a.x + share * (b.x - a.x),
                            a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)}
      .normalized();
}

}  // namespace

CubicBetween cubic_between(const SolvedPlace& from, const SolvedPlace& to, int diagonal,
                           int direction) {
  const auto d = static_cast<std::size_t>(diagonal);
  const bool both = from.point.pilot_rate > 0 && to.point.pilot_rate > 0;
  return cubic_between({from.point.lengths[d], from.point.slopes[d]},
                       {to.point.lengths[d], to.point.slopes[d]}, to.pilot_rad - from.pilot_rad,
                       both ? to.point.pilot_rate / from.point.pilot_rate : 1, direction);
}

double cubics_off(const SolvedPlace& from, const SolvedPlace& between, const SolvedPlace& to,
                  double share) {
  double off = 0;
  for (int k = 0; k < static_cast<int>(from.point.lengths.size()); ++k) {
    const auto d = static_cast<std::size_t>(k);
    const CubicBetween cubic = cubic_between(from, to, k, 1);
    const double moved = between.point.lengths[d] - from.point.lengths[d];
    const double rate = between.point.slopes[d] * (cubic.u + cubic.v * share);
    off = std::max({off, std::abs(cubic.length(share) - moved),
                    kMiddlePerRate * std::abs(cubic.rate(share) - rate)});
  }
  // It grows like the square of the product of both distances.
  assert(share > 0 && share < 1);
  const double product = 4 * share * (1 - share);
  return off / (product * product);
}

struct BetweenSolver::Workspace {
  Workspace(const Mechanism& mechanism, const Elimination& elimination)
      : corrector(mechanism, SparseClosure<double>(mechanism, elimination)),
        near(flat_state<double>(mechanism)),
        tangent(static_cast<std::size_t>(mechanism.unknowns)),
        misfits(static_cast<std::size_t>(mechanism.equations)),
        dense(mechanism),
        rooms(kMostSolvedHalvings + 2, PathPoint(mechanism)) {}

  LaneCorrector<double, SparseClosure<double>> corrector;
  FoldState<double> near;
  std::vector<double> tangent, misfits;
  DenseState dense;
  std::vector<PathPoint> rooms;  // of the ways that are halved, the longest first
};

BetweenSolver::BetweenSolver(const Mechanism& mechanism, const Elimination& elimination)
    : mechanism_(mechanism), elimination_(elimination) {}

BetweenSolver::~BetweenSolver() = default;

BetweenSolver::Workspace& BetweenSolver::workspace() {
  if (!workspace_) workspace_ = std::make_unique<Workspace>(mechanism_, elimination_);
  return *workspace_;
}

PathPoint& BetweenSolver::room(int halvings) {
  assert(halvings >= 0 && halvings <= kMostSolvedHalvings + 1);
  return workspace().rooms[static_cast<std::size_t>(halvings)];
}

void BetweenSolver::put_flat(const SheetGeometry<double>& geometry, PathPoint& point) const {
  std::fill(point.state.creases.begin(), point.state.creases.end(), HalfAngle<double>{1, 0});
  std::fill(point.state.balls.begin(), point.state.balls.end(), Quaternion<double>{1, 0, 0, 0});
  flat_lengths(mechanism_, geometry, point.lengths.data());
  std::fill(point.slopes.begin(), point.slopes.end(), 0.0);  // lengths begin like a square
  point.pilot_rate = 0;                                      // all branches meet there
}

// By the fixed order of elimination, or where that is poor by dense matrices.
bool BetweenSolver::solve(const SheetGeometry<double>& geometry, const SolvedPlace& from,
                          const SolvedPlace& to, double pilot_rad, PathPoint& point) {
  auto& [corrector, near, tangent, misfits, dense, rooms] = workspace();
  const double share = (pilot_rad - from.pilot_rad) / (to.pilot_rad - from.pilot_rad);
  const FoldState<double>&a = from.point.state, &b = to.point.state;
  for (std::size_t k = 0; k < near.creases.size(); ++k) {
    near.creases[k] = between(a.creases[k], b.creases[k], share);
  }
  for (std::size_t k = 0; k < near.balls.size(); ++k) {
    near.balls[k] = between(a.balls[k], b.balls[k], share);
  }
  const HalfAngle<double> pilot = half_angle_of_deg(pilot_rad / kRadPerDeg);
  corrector.put(geometry, near, pilot, 0);
  double corrected_rad = 0;
  for (int k = 0; k < NewtonOptions{}.max_iterations; ++k) {
    corrector.iterate(0, tangent);
    if (!std::isfinite(corrector.open_by())) return false;
    corrected_rad += corrector.largest_correction();
    if (corrector.open_by() > NewtonOptions{}.closure_tolerance) continue;
    if (corrected_rad > kFarthestFromMean_rad) return false;
    point.state = corrector.trial();
    tangent = corrector.tangent();
    const double rate = tangent.back();
    point.pilot_rate = std::abs(rate);
    folded_lengths_and_slopes(mechanism_, geometry, point.state, tangent.data(),
                              point.lengths.data(), point.slopes.data(), misfits.data());
    for (double& slope : point.slopes) slope /= rate;
    point.misfit = 0;
    for (const double rest : misfits) {
      point.misfit = std::max(point.misfit, std::abs(rest / rate));
    }
    const bool is_poor =
        !(point.misfit <= kLargestMisfit) || pilot_rad > kPoorFactorsFrom_deg * kRadPerDeg;
    if (is_poor) dense.find(geometry, point.state, point);
    return true;
  }
  return false;
}

}  // namespace misalign::solver
