#include "solver/judging/solved_bumps.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {

SolvedBumps::SolvedBumps(const Mechanism& mechanism, BetweenSolver& solver)
    : mechanism_(mechanism), solver_(solver) {}

SolvedBumps::~SolvedBumps() = default;

BumpFound SolvedBumps::look(const SheetGeometry<double>& geometry, double from_deg,
                            const PathPoint& from, double to_deg, const PathPoint& to,
                            const Judge& judge) {
  assert(from_deg < to_deg && from.lengths.size() == to.lengths.size());
  retreats_.assign(from.lengths.size(), {});
  BumpFound found;
  found.is_known = go(geometry, {from_deg * kRadPerDeg, from}, {to_deg * kRadPerDeg, to}, 0, judge);
  double longest = 0;
  for (std::size_t d = 0; d < retreats_.size(); ++d) {
    if (retreats_[d].longest < kBumpBand_widths || retreats_[d].longest <= longest) continue;
    longest = retreats_[d].longest;
    found.where = static_cast<int>(d);
    found.from_deg = retreats_[d].from_rad / kRadPerDeg;
  }
  return found;
}

bool SolvedBumps::go(const SheetGeometry<double>& geometry, const SolvedPlace& from,
                     const SolvedPlace& to, int halvings, const Judge& judge) {
  PathPoint& point = solver_.room(halvings);
  const SolvedPlace middle{from.pilot_rad + cubic_between(from, to, 0, 1).pilot(0.5), point};
  if (!solver_.solve(geometry, from, to, middle.pilot_rad, point)) return false;
  const double off = cubics_off(from, middle, to, 0.5);
  bool all_go_on = true;
  for (int d = 0; d < mechanism_.diagonal_count() && all_go_on; ++d) {
    if (judge.direction(d) == 0) continue;
    const CubicBetween cubic = cubic_between(from, to, d, judge.direction(d));
    const double bend = -cubic.c / (3 * cubic.d);  // where the rate is least or largest
    double least = std::min(cubic.rate(0), cubic.rate(1));
    if (bend > 0 && bend < 1) least = std::min(least, cubic.rate(bend));
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

void SolvedBumps::follow(const SolvedPlace& from, const SolvedPlace& to, const Judge& judge) {
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    if (judge.direction(d) == 0) continue;
    retreats_[static_cast<std::size_t>(d)].go_along(cubic_between(from, to, d, judge.direction(d)),
                                                    from.pilot_rad);
  }
}

}  // namespace misalign::solver
