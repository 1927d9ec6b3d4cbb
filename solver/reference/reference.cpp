#include "solver/reference/reference.hpp"

#include <algorithm>

#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {
namespace {

// Cubics between stations have an error of its fourth power / 384: 2e-14 for a fourth derivative of
// one panel width per rad^4.
constexpr double kLookBetween_deg = 0.1;

}  // namespace

PathPlanOptions reference_path(PathPlanOptions path, double longest_step_deg, BumpRule bumps) {
  path.longest_step_deg = longest_step_deg;
  if (bumps == BumpRule::exact) path.look_deg = std::min(longest_step_deg, kLookBetween_deg);
  return path;
}

Reference::Reference(const Mechanism& mechanism, const PathPlan& plan, const Criterion& criterion)
    : mechanism_(mechanism),
      plan_(plan),
      tracker_(mechanism),
      criterion_(criterion),
      judge_(mechanism, criterion),
      pivoted_state_(mechanism),
      point_(mechanism) {}

Verdict Reference::judge(const FlatVertices& vertices_mm) {
  place(mechanism_, vertices_mm, geometry_);
  flat_lengths(mechanism_, geometry_, point_.lengths.data());
  judge_.begin(point_.lengths, &geometry_);
  if (criterion_.bumps == BumpRule::exact) {
    std::fill(point_.slopes.begin(), point_.slopes.end(), 0.0);
    point_.pilot_rate = 0;
    visited_.assign(1, {0, point_});
  }
  path_ = tracker_.follow(
      geometry_, plan_,
      [&](const Station& station, const FoldState<double>& state) { return see(station, state); });
  return judge_.conclude(path_);
}

bool Reference::see(const Station& station, const FoldState<double>& state) {
  if (criterion_.bumps == BumpRule::exact) {
    pivoted_state_.find(geometry_, state, point_);
    return see_exactly(station);
  }
  if (station.sample == 0) return true;
  if (criterion_.bumps == BumpRule::by_cubic || station.sample == criterion_.stop_sample ||
      criterion_.asks_for_moment()) {
    pivoted_state_.find(geometry_, state, point_);
    return judge_.see(station, &point_.state, point_.lengths, &point_.slopes, point_.pilot_rate);
  }
  folded_lengths(mechanism_, geometry_, state, point_.lengths.data());
  return judge_.see(station, &state, point_.lengths);
}

bool Reference::see_exactly(const Station& station) {
  visited_.push_back({station.pilot_deg, point_});
  if (station.sample == 0) return true;
  if (!judge_.is_in_order(&point_.state, point_.lengths)) return false;
  const int where = longest_retreat();
  if (where >= 0) {
    judge_.end_between(where, point_.slopes[static_cast<std::size_t>(where)]);
    return false;
  }
  if (criterion_.finds_soft_stop(station.sample, point_.slopes)) {
    judge_.end(Fault::soft_stop, -1);
    return false;
  }
  judge_.take(station, point_.lengths);
  visited_.assign(1, {station.pilot_deg, point_});
  return true;
}

// Returns the diagonal that turns back most, by the band or more; -1: none.
int Reference::longest_retreat() const {
  int where = -1;
  double longest = 0;
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    if (judge_.direction(d) == 0) continue;
    const auto k = static_cast<std::size_t>(d);
    Retreat retreat;
    for (std::size_t i = 1; i < visited_.size(); ++i) {
      const PathPoint &from = visited_[i - 1].point, &to = visited_[i].point;
      retreat.go_along(cubic_between(
          {from.lengths[k], from.slopes[k]}, {to.lengths[k], to.slopes[k]},
          (visited_[i].pilot_deg - visited_[i - 1].pilot_deg) * kRadPerDeg,
          from.pilot_rate > 0 ? to.pilot_rate / from.pilot_rate : 1, judge_.direction(d)));
    }
    if (retreat.longest < kBumpBand_widths || retreat.longest <= longest) continue;
    longest = retreat.longest;
    where = d;
  }
  return where;
}

}  // namespace misalign::solver
