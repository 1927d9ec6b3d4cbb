#include "solver/judging/close_judge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/continuation/long_steps.hpp"

namespace misalign::solver {
namespace {

// Largest roughness of a segment on which extremes are sought (panel widths, rad): 1e-4 of that of
// long steps, whose extremes are solved once more.
constexpr double kMostRoughness = 3e-11;

// Uncertainty of a retreat that counts as solved (panel widths): the rest comes from errors of
// nodes, which shorter segments do not reduce.
constexpr double kSolved_widths = 1e-12;

// Shortest segment: on shorter ones divided differences lose more digits than the polynomials gain.
constexpr double kShortest_rad = 1e-4;

constexpr int kMostReversalSolves = 6;

}  // namespace

CloseJudge::CloseJudge(const Model& model, BetweenSolver& solver)
    : mechanism_(model.mechanism()),
      looks_for_bumps_(model.bumps() == BumpRule::exact),
      judge_(model.mechanism(), model.criterion()),
      path_(model.mechanism(), solver),
      bumps_(model.mechanism()),
      finder_(model.mechanism().diagonal_count()),
      estimate_(model.mechanism()) {}

CloseJudge::~CloseJudge() = default;
CloseJudge::CloseJudge(CloseJudge&&) = default;

void CloseJudge::begin(const std::vector<double>& flat_lengths,
                       const SheetGeometry<double>& geometry, bool finds_extremes) {
  finds_extremes_ = finds_extremes;
  judge_.begin(flat_lengths, &geometry);
  is_over_ = false;
  last_deg_ = 0;
  known_ = 0;
  if (!looks_between()) return;
  path_.begin(flat_lengths);
  bumps_.begin(flat_lengths);
  finder_.begin(flat_lengths);
  least_slope_at_last_ = std::numeric_limits<double>::infinity();
}

void CloseJudge::go_on(const PathPlan& plan, const std::vector<double>& lengths, int known) {
  assert(!finds_extremes_);
  const auto diagonals = static_cast<std::ptrdiff_t>(estimate_.lengths.size());
  auto row = lengths.begin();
  for (const Station& station : plan.stations) {
    if (row == lengths.end()) break;
    if (station.sample == 0) continue;
    estimate_.lengths.assign(row, row + diagonals);
    [[maybe_unused]] const bool is_known = judge_.is_in_order(nullptr, estimate_.lengths);
    assert(is_known);
    judge_.take(station, estimate_.lengths);
    last_deg_ = station.pilot_deg;
    row += diagonals;
  }
  known_ = known;
}

bool CloseJudge::see(const Station& station, const PathPoint& point, bool with_slopes,
                     const SheetGeometry<double>* geometry) {
  is_over_ = is_over_ || !judge_.is_in_order(&point.state, point.lengths);
  if (looks_between() && !(is_over_ && !finds_extremes_)) {
    assert(geometry && with_slopes && station.pilot_deg > last_deg_);
    if (station.sample > known_) {
      look_between(station, point, *geometry);
    } else {
      path_.pass(station, point);
      bumps_.take(station.pilot_deg * kRadPerDeg);
    }
  }
  last_deg_ = station.pilot_deg;
  if (is_over_) return false;
  is_over_ = !judge_.see(station, &point.state, point.lengths,
                         with_slopes ? &point.slopes : nullptr, point.pilot_rate);
  if (is_over_ || !finds_extremes_) return !is_over_;
  least_slope_at_last_ = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < point.slopes.size(); ++d) {
    const double slope = judge_.direction(static_cast<int>(d)) * point.slopes[d];
    least_slope_at_last_ = std::min(least_slope_at_last_, slope);
  }
  return true;
}

// Judges segment by segment up to the sample, and halves segments that are too long.
void CloseJudge::look_between(const Station& station, const PathPoint& point,
                              const SheetGeometry<double>& geometry) {
  const LeastSlope least_slope = finder_.least_slope();
  heading_ = FunctionBumps::Heading::forward;
  bool is_known = path_.aim_at(geometry, station, point);
  do {
    while (!is_short_enough()) {
      if (path_.halve()) continue;
      is_known = false;
      break;
    }
    is_known = is_known && heading_ != FunctionBumps::Heading::unsure;
    if (finds_extremes_) find_extremes();
    path_.keep();
  } while (path_.go_on());
  if (is_over_ || !looks_for_bumps_) return;
  if (is_known && heading_ == FunctionBumps::Heading::forward) {
    return bumps_.take(station.pilot_deg * kRadPerDeg);
  }
  is_over_ = true;
  finder_.restore(least_slope);
  if (!is_known) return judge_.end(Fault::undecided, -1);
  const int d = bumps_.where();
  const double oldest_deg = path_.function().pilot_at_oldest() / kRadPerDeg;
  judge_.end_between(d, point.slopes[static_cast<std::size_t>(d)],
                     goes_back_from_deg(path_.function(), d, judge_.direction(d),
                                        std::max(last_deg_, oldest_deg), station.pilot_deg));
}

// Returns whether the newest segment needs no halving, also if it cannot be halved further; if its
// polynomials have not converged it then stays unsure.
bool CloseJudge::is_short_enough() {
  const PathFunction& function = path_.function();
  const bool can_halve = path_.can_halve() && function.to() - function.from() > kShortest_rad;
  is_believed_ = true;
  if (function.count() > 1) {
    const double roughness = function.roughness();
    is_believed_ =
        roughness <= LongSteps::Options{}.most_roughness && function.to() > function.from();
    const bool is_fine = !finds_extremes_ || roughness <= kMostRoughness;
    if (can_halve && !(is_believed_ && is_fine)) return false;
  }
  if (is_over_ || !looks_for_bumps_) return true;
  if (!is_believed_) heading_ = FunctionBumps::Heading::unsure;
  if (!is_believed_ || !FunctionBumps::can_look(function)) return true;
  bumps_.begin_segment(function);
  const double end = function.end();
  const double least_doubt = can_halve ? kSolved_widths : std::numeric_limits<double>::infinity();
  heading_ = path_.is_at_sample() ? bumps_.look_at_sample(end, judge_, function, least_doubt)
                                  : bumps_.look_at_end(judge_, function, least_doubt);
  return heading_ != FunctionBumps::Heading::unsure || !can_halve;
}

void CloseJudge::find_extremes() {
  const PathFunction& function = path_.function();
  if (function.count() < 2) return;
  estimate_.lengths = path_.end().lengths;
  estimate_.slopes = path_.end().slopes;
  const double end_deg = path_.end_rad() / kRadPerDeg;
  if (!is_believed_) return finder_.pass(end_deg, estimate_);
  const bool had_reversed = finder_.first_reversal().diagonal >= 0;
  finder_.see(end_deg, !is_over_, function.end(), estimate_, judge_, function);
  if (!had_reversed && finder_.first_reversal().pilot_deg > 0) solve_reversal();
}

void CloseJudge::solve_reversal() {
  ReversalSecants secants(finder_.first_reversal());
  std::optional<double> at_deg = finder_.first_reversal().pilot_deg;
  for (int k = 0; k < kMostReversalSolves && at_deg; ++k) {
    const PathPoint* const point = path_.state_at(*at_deg * kRadPerDeg);
    if (!point) return;
    at_deg = secants.next_deg(point->slopes);
  }
  if (secants.is_sure()) finder_.put_reversal(secants.reversal().pilot_deg);
}

PathExtremes CloseJudge::extremes() const {
  PathExtremes extremes = finder_.extremes();
  extremes.drop_bump();  // the bump is in between()
  extremes.least_slope = finder_.least_slope().slope;
  if (std::isfinite(extremes.least_slope)) {
    extremes.least_slope = std::min(extremes.least_slope, least_slope_at_last_);
  }
  return extremes;
}

}  // namespace misalign::solver
