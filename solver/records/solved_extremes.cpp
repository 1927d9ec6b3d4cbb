#include "solver/records/solved_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace misalign::solver {
namespace {

// The error of a cubic's second derivative along its way of length one, to its error in the middle:
// 32 where its fourth derivative is constant, and four times that for safety.
constexpr double kBendPerMiddle = 128;

// Of a cubic's error in the middle a half has a sixteenth, next to a limit point more.
constexpr double kOffOfHalf = 0.25;

// A rate of change lower by less than this (panel widths per radian) is not looked for.
constexpr double kLowerSlope = 1e-9;

// How well a turn is wanted: 6e-8 degrees.
constexpr double kSameTurn_rad = 1e-9;
constexpr int kMostTurnSolves = 40;

// A cubic's rate of change per radian of pilot, between its ends.
struct SlopeBetween {
  const CubicBetween cubic;
  double bend_here =
      2 * cubic.c * cubic.u - cubic.v * cubic.b;  // its derivative, times the pilot's rate^3
  double bend_next = bend_here + 6 * cubic.d * cubic.u + 3 * cubic.d * cubic.v;

  // Whether it only falls or only rises, for all that the cubic may be off in its middle.
  bool is_one_way(double off) const {
    const double error = off * (kBendPerMiddle * std::max(cubic.u, cubic.u + cubic.v) +
                                kRatePerMiddle * std::abs(cubic.v));
    return std::min(bend_here, bend_next) > error || std::max(bend_here, bend_next) < -error;
  }
  // A bound from below.
  double lowest(double off) const {
    const double bend = cubic.d == 0 ? 0 : std::clamp(-cubic.c / (3 * cubic.d), 0.0, 1.0);
    const double rate =
        std::min({cubic.rate(0), cubic.rate(1), cubic.rate(bend)}) - kRatePerMiddle * off;
    const auto [slow, fast] = std::minmax({cubic.u, cubic.u + cubic.v});
    return rate / (rate < 0 ? slow : fast);
  }
  bool has_dip() const { return bend_here < 0 && bend_next > 0; }
  // Where: the root of bend_here + 6 d u t + 3 d v t^2.
  double dip() const {
    const double half = 3 * cubic.d * cubic.u;
    return -bend_here / (half + std::sqrt(half * half - 3 * cubic.d * cubic.v * bend_here));
  }
};

}  // namespace

SolvedExtremes::SolvedExtremes(const Mechanism& mechanism, BetweenSolver& solver)
    : mechanism_(mechanism), solver_(solver), before_last_(mechanism), last_(mechanism) {}

SolvedExtremes::~SolvedExtremes() = default;
SolvedExtremes::SolvedExtremes(SolvedExtremes&&) = default;

void SolvedExtremes::begin(const SheetGeometry<double>& geometry) {
  extremes_ = {};
  before_last_rad_ = last_rad_ = 0;
  solver_.put_flat(geometry, last_);
}

void SolvedExtremes::see(const SheetGeometry<double>& geometry, const Station& station,
                         const PathPoint& point, const Judge& judge) {
  geometry_ = &geometry;
  const SolvedPlace here{station.pilot_deg * kRadPerDeg, point};
  const SolvedPlace last{last_rad_, last_}, before{before_last_rad_, before_last_};
  counts_ = station.sample <= judge.samples_in_order() &&
            last_rad_ >= kInactiveFrom_deg * kRadPerDeg - 1e-12;
  if (last_rad_ == 0) {
    look_from_flat(here, judge);
  } else if (may_turn() || counts_) {
    const CubicBetween both = cubic_between(before, here, 0, 1);
    const double cubic = last_rad_ - before_last_rad_;
    const double share = 2 * cubic / (both.u + std::sqrt(both.u * both.u + 2 * both.v * cubic));
    go(last, here, kOffOfHalf * cubics_off(before, last, here, share), 0, judge);
  }
  before_last_rad_ = std::exchange(last_rad_, here.pilot_rad);
  std::swap(before_last_, last_);
  last_ = point;
}

void SolvedExtremes::look_from_flat(const SolvedPlace& here, const Judge& judge) {
  const SolvedPlace flat{0, last_};
  double first_rad = here.pilot_rad;
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    const int direction = judge.direction(d);
    const auto k = static_cast<std::size_t>(d);
    const double on = direction * (here.point.lengths[k] - last_.lengths[k]);
    const double slope = direction * here.point.slopes[k];
    const FromFlat from_flat(on, slope, here.pilot_rad);
    if (direction == 0) continue;
    if (from_flat.sets_out_back()) {
      first_rad = 0;
    } else if (slope < 0 && first_rad > 0) {
      const double near_rad =
          here.pilot_rad * std::sqrt(std::max(from_flat.square, 0.0) / (-2 * from_flat.fourth));
      first_rad = std::min(first_rad, turn_between(flat, here,
                                                   {d, direction, near_rad, here.pilot_rad,
                                                    direction * here.point.slopes[k]}));
    }
  }
  if (first_rad < here.pilot_rad) extremes_.reverses_deg = first_rad / kRadPerDeg;
}

void SolvedExtremes::take_slopes(const PathPoint& point, const Judge& judge) {
  for (std::size_t d = 0; counts_ && d < point.slopes.size(); ++d) {
    const int direction = judge.direction(static_cast<int>(d));
    if (direction == 0) continue;
    extremes_.least_slope = std::min(extremes_.least_slope, direction * point.slopes[d]);
  }
}

// Whether no diagonal has anything to look for here but at the ends, or between them a turn.
bool SolvedExtremes::is_clear(const SolvedPlace& from, const SolvedPlace& to, double off,
                              const Judge& judge) const {
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    if (judge.direction(d) == 0) continue;
    const SlopeBetween slope{cubic_between(from, to, d, judge.direction(d))};
    if (slope.is_one_way(off)) continue;
    const double lowest = slope.lowest(off);
    if (may_turn() && lowest < 0) return false;
    if (counts_ && lowest < extremes_.least_slope - kLowerSlope) return false;
  }
  return true;
}

void SolvedExtremes::go(const SolvedPlace& from, const SolvedPlace& to, double off, int halvings,
                        const Judge& judge) {
  take_slopes(from.point, judge);
  take_slopes(to.point, judge);
  PathPoint& point = solver_.room(halvings);
  const SolvedPlace middle{from.pilot_rad + cubic_between(from, to, 0, 1).pilot(0.5), point};
  if (off <= kSolved_widths || halvings == kMostSolvedHalvings || is_clear(from, to, off, judge) ||
      !solver_.solve(*geometry_, from, to, middle.pilot_rad, point)) {
    solve_turns(from, to, judge);
    return;
  }
  const double off_of_half = kOffOfHalf * cubics_off(from, middle, to, 0.5);
  go(from, middle, off_of_half, halvings + 1, judge);
  go(middle, to, off_of_half, halvings + 1, judge);
}

// What the cubics show is solved where it is.
void SolvedExtremes::solve_turns(const SolvedPlace& from, const SolvedPlace& to,
                                 const Judge& judge) {
  const bool may_turn_here = may_turn();
  double first_rad = to.pilot_rad;
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    const int direction = judge.direction(d);
    if (direction == 0) continue;
    const auto k = static_cast<std::size_t>(d);
    const double next_slope = direction * to.point.slopes[k];
    const SlopeBetween slope{cubic_between(from, to, d, direction)};
    const bool was_on = may_turn_here && direction * from.point.slopes[k] >= 0;
    double first, second;
    slope.cubic.find_turns(first, second);
    if (was_on && next_slope < 0) {
      const double near_rad = slope.cubic.pilot(first > 0 && first < 1 ? first : second);
      first_rad = std::min(first_rad, turn_between(from, to,
                                                   {d, direction, from.pilot_rad + near_rad,
                                                    to.pilot_rad, next_slope}));
    }
    const double lowest = slope.lowest(0);
    const bool may_dip = was_on && next_slope >= 0 && lowest < 0;
    if (!slope.has_dip() || !(may_dip || (counts_ && lowest < extremes_.least_slope))) continue;
    PathPoint& point = solver_.room(kMostSolvedHalvings + 1);
    const double dip_rad = from.pilot_rad + slope.cubic.pilot(slope.dip());
    if (!solver_.solve(*geometry_, from, to, dip_rad, point)) continue;
    take_slopes(point, judge);
    const double dip_slope = direction * point.slopes[k];
    if (!may_dip || !(dip_slope < 0)) continue;
    const double near_rad = from.pilot_rad + slope.cubic.pilot(first);
    first_rad =
        std::min(first_rad, turn_between(from, to, {d, direction, near_rad, dip_rad, dip_slope}));
  }
  if (first_rad < to.pilot_rad) extremes_.reverses_deg = first_rad / kRadPerDeg;
}

// Where the diagonal's rate of change falls to zero, by secants.
double SolvedExtremes::turn_between(const SolvedPlace& from, const SolvedPlace& to,
                                    const Turn& turn) {
  PathPoint& point = solver_.room(kMostSolvedHalvings + 1);
  double low = from.pilot_rad, high = turn.high_rad, at = turn.near_rad;
  double last = high, last_slope = turn.high_slope;
  for (int k = 0; k < kMostTurnSolves; ++k) {
    if (!solver_.solve(*geometry_, from, to, at, point)) break;
    const double slope = turn.direction * point.slopes[static_cast<std::size_t>(turn.diagonal)];
    (slope < 0 ? high : low) = at;
    double next = at - slope * (at - last) / (slope - last_slope);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    last = std::exchange(at, next);
    last_slope = slope;
    if (std::abs(at - last) <= kSameTurn_rad) break;
  }
  return at;
}

}  // namespace misalign::solver
