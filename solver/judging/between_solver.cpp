#include "solver/judging/between_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "solver/continuation/lane_corrector.hpp"
#include "solver/linear/newton.hpp"
#include "solver/model/pivoted_state.hpp"

namespace misalign::solver {
namespace {

// Largest sum of corrections from a prediction (rad).
constexpr double kFarthest_rad = 0.2;

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
  PivotedState dense;
};

BetweenSolver::BetweenSolver(const Mechanism& mechanism, const Elimination& elimination)
    : mechanism_(mechanism), elimination_(elimination) {}

BetweenSolver::~BetweenSolver() = default;

void BetweenSolver::prepare() {
  if (!workspace_) workspace_ = std::make_unique<Workspace>(mechanism_, elimination_);
}

// Predicts by the rates of the nearer place, unless that is flat, which has none. Uses the fixed
// order of elimination, or factors with pivoting where that is poor.
bool BetweenSolver::solve(const SheetGeometry<double>& geometry, const SolvedPlace& from,
                          const SolvedPlace& to, double pilot_rad, PathPoint& point) {
  prepare();
  auto& [corrector, near, tangent, misfits, dense] = *workspace_;
  const bool is_nearer_from = pilot_rad - from.pilot_rad <= to.pilot_rad - pilot_rad;
  const SolvedPlace& place = is_nearer_from && from.pilot_rad > 0 ? from : to;
  assert(place.point.rates.size() == tangent.size());
  const double by_rad = pilot_rad - place.pilot_rad;
  std::ranges::transform(place.point.rates, tangent.begin(),
                         [&](double rate) { return by_rad * rate; });
  near = place.point.state;
  advance(mechanism_, tangent.data(), near);
  const HalfAngle<double> pilot = half_angle_of_rad(pilot_rad);
  corrector.put(geometry, near, pilot, 0);
  double corrected_rad = 0;
  for (int k = 0; k < Newton::Options{}.max_iterations; ++k) {
    corrector.iterate(0, tangent);
    if (!std::isfinite(corrector.open_by())) return false;
    corrected_rad += corrector.largest_correction();
    if (corrector.open_by() > Newton::Options{}.closure_tolerance) continue;
    if (corrected_rad > kFarthest_rad) return false;
    point.state = corrector.trial();
    tangent = corrector.tangent();
    const double rate = tangent.back();
    point.pilot_rate = std::abs(rate);
    folded_lengths_and_slopes(mechanism_, geometry, point.state, tangent.data(),
                              point.lengths.data(), point.slopes.data(), misfits.data());
    for (double& slope : point.slopes) slope /= rate;
    point.rates.resize(tangent.size());
    std::ranges::transform(tangent, point.rates.begin(),
                           [rate](double entry) { return entry / rate; });
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
