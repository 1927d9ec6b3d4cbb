#include "solver/verdict/solved_bumps.hpp"

#include <algorithm>
#include <cmath>

#include "solver/continuation/lane_corrector.hpp"
#include "solver/linear/newton.hpp"

namespace misalign::solver {
namespace {

// Cubics this close to the solved state in their middle are as good as solved themselves: each half
// has a sixteenth of that error.
constexpr double kSolved_widths = 1e-12;

// The error of a cubic's rate along its way of length one, to its error in the middle: 3.1 where
// its fourth derivative is constant, and four times that for safety. An error of its rate in the
// middle counts an eighth: there the fifth derivative shows, and the fourth does not.
constexpr double kRatePerMiddle = 12.5, kMiddlePerRate = 0.125;

// What a state in the middle may be away from its neighbours' mean (rad), and how often a way is
// halved at most.
constexpr double kLongestCorrection_rad = 0.2;
constexpr int kMostSolvedHalvings = 16;

HalfAngle<double> between(const HalfAngle<double>& a, const HalfAngle<double>& b, double share) {
  return HalfAngle<double>{a.c + share * (b.c - a.c), a.s + share * (b.s - a.s)}.turned(0);
}

Quaternion<double> between(const Quaternion<double>& a, const Quaternion<double>& b, double share) {
  return Quaternion<double>{a.w + share * (b.w - a.w), a.x + share * (b.x - a.x),
                            a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)}
      .normalized();
}

}  // namespace

struct SolvedBumps::Workspace {
  Workspace(const Mechanism& mechanism, const Elimination& elimination)
      : corrector(mechanism, SparseClosure<double>(mechanism, elimination)),
        near(flat_state<double>(mechanism)),
        tangent(static_cast<std::size_t>(mechanism.unknowns)),
        misfits(static_cast<std::size_t>(mechanism.equations)),
        dense(mechanism),
        middles(kMostSolvedHalvings + 1, PathPoint(mechanism)) {}

  LaneCorrector<double, SparseClosure<double>> corrector;
  FoldState<double> near;
  std::vector<double> tangent, misfits;
  DenseState dense;
  std::vector<PathPoint> middles;  // of the ways that are halved, the longest first
};

SolvedBumps::SolvedBumps(const Mechanism& mechanism, const Elimination& elimination)
    : mechanism_(mechanism), elimination_(elimination) {}

SolvedBumps::~SolvedBumps() = default;

void SolvedBumps::put_flat(const SheetGeometry<double>& geometry, PathPoint& point) const {
  std::fill(point.state.creases.begin(), point.state.creases.end(), HalfAngle<double>{1, 0});
  std::fill(point.state.balls.begin(), point.state.balls.end(), Quaternion<double>{1, 0, 0, 0});
  flat_lengths(mechanism_, geometry, point.lengths.data());
  std::fill(point.slopes.begin(), point.slopes.end(), 0.0);  // lengths begin like a square
  point.pilot_rate = 0;                                      // all branches meet there
}

BumpFound SolvedBumps::look(const SheetGeometry<double>& geometry, double from_deg,
                            const PathPoint& from, double to_deg, const PathPoint& to,
                            const Judge& judge) {
  if (!workspace_) workspace_ = std::make_unique<Workspace>(mechanism_, elimination_);
  ways_.assign(from.lengths.size(), {});
  BumpFound found;
  found.is_known = go(geometry, {from_deg * kRadPerDeg, from}, {to_deg * kRadPerDeg, to}, 0, judge);
  double longest = 0;
  for (std::size_t d = 0; d < ways_.size(); ++d) {
    if (ways_[d].longest < kBumpBand_widths || ways_[d].longest <= longest) continue;
    longest = ways_[d].longest;
    found.where = static_cast<int>(d);
  }
  return found;
}

CubicBetween SolvedBumps::cubic(const End& from, const End& to, int diagonal, int direction) const {
  const auto d = static_cast<std::size_t>(diagonal);
  const bool both = from.point.pilot_rate > 0 && to.point.pilot_rate > 0;
  return cubic_between({from.point.lengths[d], from.point.slopes[d]},
                       {to.point.lengths[d], to.point.slopes[d]}, to.pilot_rad - from.pilot_rad,
                       both ? to.point.pilot_rate / from.point.pilot_rate : 1, direction);
}

bool SolvedBumps::go(const SheetGeometry<double>& geometry, const End& from, const End& to,
                     int halvings, const Judge& judge) {
  PathPoint& point = workspace_->middles[static_cast<std::size_t>(halvings)];
  const End middle{from.pilot_rad + cubic(from, to, 0, 1).pilot(0.5), point};
  if (!solve(geometry, from, to, middle.pilot_rad, point)) return false;
  double off = 0;
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    const CubicBetween way = cubic(from, to, d, 1);
    const double moved = point.lengths[static_cast<std::size_t>(d)] -
                         from.point.lengths[static_cast<std::size_t>(d)];
    const double rate = point.slopes[static_cast<std::size_t>(d)] * (way.u + way.v / 2);
    off = std::max(
        {off, std::abs(way.length(0.5) - moved), kMiddlePerRate * std::abs(way.rate(0.5) - rate)});
  }
  bool all_go_on = true;
  for (int d = 0; d < mechanism_.diagonal_count() && all_go_on; ++d) {
    if (judge.direction(d) == 0) continue;
    const CubicBetween way = cubic(from, to, d, judge.direction(d));
    const double bend = -way.c / (3 * way.d);  // where the rate is least or largest
    double least = std::min(way.rate(0), way.rate(1));
    if (bend > 0 && bend < 1) least = std::min(least, way.rate(bend));
    all_go_on = least > kRatePerMiddle * off;
  }
  if (all_go_on || off <= kSolved_widths || halvings == kMostSolvedHalvings) {
    follow(from, middle, judge);
    follow(middle, to, judge);
    return true;
  }
  return go(geometry, from, middle, halvings + 1, judge) &&
         go(geometry, middle, to, halvings + 1, judge);
}

void SolvedBumps::follow(const End& from, const End& to, const Judge& judge) {
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    if (judge.direction(d) == 0) continue;
    ways_[static_cast<std::size_t>(d)].go_along(cubic(from, to, d, judge.direction(d)));
  }
}

// By the fixed order of elimination, or where that is poor by dense matrices.
bool SolvedBumps::solve(const SheetGeometry<double>& geometry, const End& from, const End& to,
                        double pilot_rad, PathPoint& point) {
  auto& [corrector, near, tangent, misfits, dense, middles] = *workspace_;
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
    if (corrected_rad > kLongestCorrection_rad) return false;
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
