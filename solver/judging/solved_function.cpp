#include "solver/judging/solved_function.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {
namespace {

// Shortest part of a segment: if no state is found there, the path does not lead to its end.
constexpr double kShortestPart = 1.0 / 64;

}  // namespace

SolvedFunction::SolvedFunction(const Mechanism& mechanism, BetweenSolver& solver)
    : mechanism_(mechanism),
      solver_(solver),
      function_(mechanism),
      last_(mechanism),
      rooms_{PathPoint(mechanism), PathPoint(mechanism)} {
  for (PathPoint* const point : {&last_, &rooms_[0], &rooms_[1]}) {
    point->rates.resize(static_cast<std::size_t>(mechanism.unknowns));
  }
}

SolvedFunction::~SolvedFunction() = default;
SolvedFunction::SolvedFunction(SolvedFunction&&) = default;

// All branches meet at flat, where lengths are stationary.
void SolvedFunction::begin(const std::vector<double>& flat_lengths) {
  function_.begin(flat_lengths.data());
  std::ranges::fill(last_.state.creases, HalfAngle<double>{1, 0});
  std::ranges::fill(last_.state.balls, Quaternion<double>{1, 0, 0, 0});
  last_rad_ = 0;
}

bool SolvedFunction::aim_at(const SheetGeometry<double>& geometry, const Station& sample,
                            const PathPoint& point) {
  assert(sample.pilot_deg * kRadPerDeg > last_rad_ && !point.rates.empty());
  geometry_ = &geometry;
  solves_ = 0;
  begin_segment(sample, point);
  return function_.count() > 1 || halve();
}

void SolvedFunction::pass(const Station& sample, const PathPoint& point) {
  begin_segment(sample, point);
  keep();
}

void SolvedFunction::begin_segment(const Station& sample, const PathPoint& point) {
  sample_ = &point;
  end_rad_ = sample_rad_ = sample.pilot_deg * kRadPerDeg;
  add();
}

// If the path bends sharply, a state may be found only near the beginning, not in the middle.
bool SolvedFunction::halve() {
  function_.drop();
  const double length_rad = end_rad_ - last_rad_;
  bool is_solved = false;
  for (double part = 0.5; !is_solved && can_halve() && part >= kShortestPart; part *= 0.5) {
    is_solved = solve(last_rad_ + part * length_rad);
  }
  add();
  return is_solved;
}

void SolvedFunction::keep() {
  length_rad_ = end_rad_ - last_rad_;
  last_ = end();
  last_rad_ = end_rad_;
}

bool SolvedFunction::go_on() {
  if (is_at_sample()) return false;
  end_rad_ = sample_rad_;
  const double next_rad = last_rad_ + 2 * length_rad_;
  // The rest must be a segment too, longer than rounding.
  if (can_halve() && sample_rad_ - next_rad > 0.5 * length_rad_) solve(next_rad);
  add();
  return true;
}

// Solves a state between the last place and the end, and makes it the end if it is found.
bool SolvedFunction::solve(double pilot_rad) {
  ++solves_;
  if (!state_at(pilot_rad)) return false;
  middle_ = 1 - middle_;
  end_rad_ = pilot_rad;
  return true;
}

const PathPoint* SolvedFunction::state_at(double pilot_rad) {
  PathPoint& point = rooms_[1 - middle_];
  const bool is_found =
      solver_.solve(*geometry_, {last_rad_, last_}, {end_rad_, end()}, pilot_rad, point);
  return is_found ? &point : nullptr;
}

void SolvedFunction::add() {
  const PathPoint& point = end();
  PathFunction::Node& node = function_.vacant();
  node.creases = point.state.creases;
  for (std::size_t k = 0; k < node.crease_rates.size(); ++k) {
    const auto column = static_cast<std::size_t>(mechanism_.creases[k].column);
    node.crease_rates[k] = point.rates[column] * point.pilot_rate;
  }
  for (std::size_t d = 0; d < node.slopes.size(); ++d) {
    node.slopes[d] = point.slopes[d] * point.pilot_rate;
  }
  node.lengths = point.lengths;
  node.misfit = point.misfit * point.pilot_rate;
  function_.add();
}

}  // namespace misalign::solver
