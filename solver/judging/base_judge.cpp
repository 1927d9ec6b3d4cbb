#include "solver/judging/base_judge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/pattern/parallel_family.hpp"

namespace misalign::solver {
namespace {

// Pilot angle whose half has this squared tangent.
HalfAngle<double> angle_of(double tangent_sq) {
  const double cosine_sq = 1 / (1 + tangent_sq);
  return {std::sqrt(cosine_sq), std::sqrt(tangent_sq * cosine_sq)};
}

}  // namespace

BaseJudge::BaseJudge(const Model& model)
    : model_(model), judge_(model.mechanism(), model.criterion()) {
  assert(model.is_overconstrained());
  double misfit_rad = 0;
  holes_ = std::get<std::vector<BaseHole>>(base_holes(model.base(), misfit_rad));
  assert(2 * holes_.size() == model.mechanism().diagonals.size());
  lengths_.resize(2 * holes_.size());
  slopes_ = lengths_;
  const auto& energy = model.criterion().energy;
  if (!energy || energy->least_friction_n_mm_per_mm == 0) return;
  for (const Station& station : model.path().stations) {
    if (station.sample == 0) continue;
    states_.push_back(base_state(model.mechanism(), model.base().folding,
                                 model.base().sheet.vertices_mm, station.pilot));
  }
}

Verdict BaseJudge::judge(const FlatVertices& vertices_mm) {
  const double width_mm = model_.mechanism().panel_width_mm;
  motions_.clear();
  for (const BaseHole& hole : holes_) motions_.emplace_back(hole, hole_edges(hole, vertices_mm));
  for (std::size_t d = 0; d < lengths_.size(); ++d) {
    lengths_[d] = motions_[d / 2].flat_mm(static_cast<int>(d % 2)) / width_mm;
  }
  place(model_.mechanism(), vertices_mm, geometry_);
  judge_.begin(lengths_, &geometry_);
  const FlatVertices shifts_mm = vertices_mm - model_.base().sheet.vertices_mm;
  if (parallel_misfit(model_.base(), shifts_mm).mm > kMemberWithin_mm) {
    return judge_.conclude({PathEnd::start_lost, 0, 0, 0, 0});
  }
  HalfAngle<double> before{1, 0};
  for (const Station& station : model_.path().stations) {
    if (station.sample == 0) continue;
    for (std::size_t d = 0; d < lengths_.size(); ++d) {
      const auto which = static_cast<int>(d % 2);
      lengths_[d] = motions_[d / 2].length_mm(which, station.pilot) / width_mm;
      slopes_[d] = motions_[d / 2].slope_mm(which, station.pilot) / width_mm;
    }
    if (!judge_.is_in_order(nullptr, lengths_)) break;
    if (model_.bumps() == BumpRule::exact) {
      const int d = goes_back_between(before, station.pilot);
      if (d >= 0) {
        const double turns_deg =
            angle_deg(angle_of(motions_[static_cast<std::size_t>(d / 2)].turns().front()));
        judge_.end_between(d, slopes_[static_cast<std::size_t>(d)], turns_deg);
        break;
      }
    }
    const FoldState<double>* const state =
        states_.empty() ? nullptr : &states_[static_cast<std::size_t>(station.sample - 1)];
    if (!judge_.see(station, state, lengths_, &slopes_)) break;
    before = station.pilot;
  }
  return judge_.conclude({PathEnd::end_reached, model_.path().stations.back().pilot_deg, 0, 0, 0});
}

int BaseJudge::goes_back_between(const HalfAngle<double>& from, const HalfAngle<double>& to) const {
  const auto is_between = [&](double turn) {
    return turn * from.c * from.c > from.s * from.s && turn * to.c * to.c < to.s * to.s;
  };
  double most_mm = kBumpBand_widths * model_.mechanism().panel_width_mm;
  int where = -1;
  for (std::size_t d = 0; d < lengths_.size(); ++d) {
    const auto [first, second] = motions_[d / 2].turns();
    if (!is_between(first)) continue;
    const HalfAngle<double> until = is_between(second) ? angle_of(second) : to;
    const auto length_mm = [&](const HalfAngle<double>& pilot) {
      return motions_[d / 2].length_mm(static_cast<int>(d % 2), pilot);
    };
    const double back_mm = std::abs(length_mm(angle_of(first)) - length_mm(until));
    if (back_mm > most_mm) most_mm = back_mm, where = static_cast<int>(d);
  }
  return where;
}

std::optional<double> BaseJudge::reverses_deg() const {
  double first = std::numeric_limits<double>::infinity();
  for (const HoleMotion& motion : motions_) first = std::min(first, motion.turns().front());
  if (!std::isfinite(first)) return {};
  const double reverses_deg = angle_deg(angle_of(first));
  if (reverses_deg > model_.path().stations.back().pilot_deg) return {};
  return reverses_deg;
}

}  // namespace misalign::solver
