#include "solver/judging/close_judge.hpp"

#include <cassert>

namespace misalign::solver {

CloseJudge::CloseJudge(const Model& model, SolvedBumps& bumps)
    : model_(model),
      judge_(model.mechanism(), model.criterion()),
      last_(model.mechanism()),
      bumps_(bumps) {}

CloseJudge::~CloseJudge() = default;
CloseJudge::CloseJudge(CloseJudge&&) = default;

void CloseJudge::begin(const SheetGeometry<double>& geometry,
                       const std::vector<double>& flat_lengths) {
  judge_.begin(flat_lengths);
  is_over_ = false;
  if (!looks_between()) return;
  last_deg_ = 0;
  bumps_.put_flat(geometry, last_);
}

bool CloseJudge::see(const Station& station, const PathPoint& point, bool with_slopes,
                     const SheetGeometry<double>* geometry) {
  if (looks_between() && !is_over_) {
    assert(geometry && station.pilot_deg > last_deg_);
    if (!judge_.is_in_order(&point.state, point.lengths)) {
      is_over_ = true;
    } else {
      const BumpFound found =
          bumps_.look(*geometry, last_deg_, last_, station.pilot_deg, point, judge_);
      is_over_ = !found.is_known || found.where >= 0;
      if (!found.is_known) {
        judge_.end(Fault::undecided, -1);
      } else if (is_over_) {
        judge_.end_between(found.where, point.slopes[static_cast<std::size_t>(found.where)],
                           found.from_deg);
      }
    }
    last_deg_ = station.pilot_deg;
    last_ = point;
  }
  if (is_over_) return false;
  return judge_.see(station, &point.state, point.lengths, with_slopes ? &point.slopes : nullptr,
                    point.pilot_rate);
}

}  // namespace misalign::solver
