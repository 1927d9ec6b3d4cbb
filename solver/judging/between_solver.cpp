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

// What a state may be away from its prediction (rad).
constexpr double kFarthest_rad = 0.2;

HalfAngle<double> between(const HalfAngle<double>& a, const HalfAngle<double>& b, double share) {
  return HalfAngle<double>{a.c + share * (b.c - a.c), a.s + share * (b.s - a.s)}.turned(0);
}

Quaternion<double> between(const Quaternion<double>& a, const Quaternion<double>& b, double share) {
  return Quaternion<double>{a.w + share * (b.w - a.w), a.x + share * (b.x - a.x),
                            a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)}
      .normalized();
}

}  // namespace

struct BetweenSolver::Workspace {
  Workspace(const Mechanism& mechanism, const Elimination& elimination)
      : corrector(mechanism, SparseClosure<double>(mechanism, elimination)),
        near(flat_state<double>(mechanism)),
        tangent(static_cast<std::size_t>(mechanism.unknowns)),
        misfits(static_cast<std::size_t>(mechanism.equations)),
        dense(mechanism) {}

  LaneCorrector<double, SparseClosure<double>> corrector;
  FoldState<double> near;
  std::vector<double> tangent, misfits;
  DenseState dense;
};

BetweenSolver::BetweenSolver(const Mechanism& mechanism, const Elimination& elimination)
    : mechanism_(mechanism), elimination_(elimination) {}

BetweenSolver::~BetweenSolver() = default;

void BetweenSolver::prepare() {
  if (!workspace_) workspace_ = std::make_unique<Workspace>(mechanism_, elimination_);
}

// Predicted by the mean of both places; where that is too far off, next to a place where the path
// bends sharply, by the rates of the first.
bool BetweenSolver::solve(const SheetGeometry<double>& geometry, const SolvedPlace& from,
                          const SolvedPlace& to, double pilot_rad, PathPoint& point) {
  prepare();
  FoldState<double>& near = workspace_->near;
  const double share = (pilot_rad - from.pilot_rad) / (to.pilot_rad - from.pilot_rad);
  const FoldState<double>&a = from.point.state, &b = to.point.state;
  for (std::size_t k = 0; k < near.creases.size(); ++k) {
    near.creases[k] = between(a.creases[k], b.creases[k], share);
  }
  for (std::size_t k = 0; k < near.balls.size(); ++k) {
    near.balls[k] = between(a.balls[k], b.balls[k], share);
  }
  if (correct(geometry, pilot_rad, point)) return true;
  std::vector<double>& turn = workspace_->tangent;
  assert(from.point.rates.size() == turn.size());
  const double by_rad = pilot_rad - from.pilot_rad;
  std::ranges::transform(from.point.rates, turn.begin(),
                         [&](double rate) { return by_rad * rate; });
  near = a;
  advance(mechanism_, turn.data(), near);
  return correct(geometry, pilot_rad, point);
}

// From the predicted state; by the fixed order of elimination, or where that is poor by dense
// matrices.
bool BetweenSolver::correct(const SheetGeometry<double>& geometry, double pilot_rad,
                            PathPoint& point) {
  auto& [corrector, near, tangent, misfits, dense] = *workspace_;
  const HalfAngle<double> pilot = half_angle_of_deg(pilot_rad / kRadPerDeg);
  corrector.put(geometry, near, pilot, 0);
  double corrected_rad = 0;
  for (int k = 0; k < NewtonOptions{}.max_iterations; ++k) {
    corrector.iterate(0, tangent);
    if (!std::isfinite(corrector.open_by())) return false;
    corrected_rad += corrector.largest_correction();
    if (corrector.open_by() > NewtonOptions{}.closure_tolerance) continue;
    if (corrected_rad > kFarthest_rad) return false;
    point.state = corrector.trial();
    tangent = corrector.tangent();
    const double rate = tangent.back();
    point.pilot_rate = std::abs(rate);
    folded_lengths_and_slopes(mechanism_, geometry, point.state, tangent.data(),
                              point.lengths.data(), point.slopes.data(), misfits.data());
    for (double& slope : point.slopes) slope /= rate;
    point.rates.resize(tangent.size());
    std::ranges::transform(tangent, point.rates.begin(), [rate](double of) { return of / rate; });
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
