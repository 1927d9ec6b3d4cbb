// Rejection tests in lanes: one sheet per lane, all at one level (a LevelSolver); then those that
// are left, from state to state along their paths.
#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/lanes/kept_states.hpp"
#include "solver/lanes/level_solver.hpp"

namespace misalign::solver {

/// Solves open sheets and shows `rules` (a RejectionTest) what it finds. `states` keeps the last
/// reliable state of each sheet that is not decided then.
template <class T>
class LaneTest {
 public:
  /// `model` must outlive this object.
  explicit LaneTest(const Model& model);

  /// Solves sheets at one of the model's test places, from the base folding; shifts grow in
  /// `shift_steps` steps. Their states are kept if it `keeps` any.
  template <class Rules>
  void run(int place, bool keeps, const ShiftBlock& block, std::vector<Undecided>& open,
           Rules& rules, KeptStates& states, int shift_steps = 1);
  /// Solves sheets again that another precision left in doubt, from states kept at this place.
  template <class Rules>
  void run_again(int place, const ShiftBlock& block, std::vector<Undecided>& open, Rules& rules,
                 KeptStates& states);
  /// Steps from the kept states along their tangents, the farther the shorter, and to each of the
  /// last samples. A step that loses its path is halved, or whose pilot turns back in doubt.
  template <class Rules>
  void run_ahead(const ShiftBlock& block, std::vector<Undecided>& open, Rules& rules,
                 KeptStates& states);

  const Effort& effort() const { return effort_; }

 private:
  template <class Work>
  void each_vector(const ShiftBlock& block, std::vector<Undecided>& open, const Work& work);
  void take_kept(Undecided* open, int count, KeptStates& states);
  template <class Rules>
  void report_all(int place, bool keeps, Undecided* open, int count, Rules& rules,
                  KeptStates& states);
  template <class Rules>
  bool report(int place, double farthest_deg, double pilot_deg, int sample, int sheet, int i,
              double error, Rules& rules);
  ObservedState::Creases creases_in_lane(int i);
  void keep(double pilot_deg, bool goes_on, int next_sample, double longest_deg, int i,
            KeptStates::State& kept) const;
  double pilot_deg(int i) const {
    const auto& pilot = solver_.state().creases[mechanism_.pilot];
    return angle_deg(HalfAngle<double>{lane(pilot.c, i), lane(pilot.s, i)});
  }

  const Mechanism& mechanism_;
  const std::vector<TestPlace>& places_;
  const double sample_deg_;
  LevelSolver<T> solver_;
  std::vector<double> rounding_;  // per place
  double way_per_level_;  // arc length per level (rad), of the base folding at the far place
  FoldState<T> start_;
  std::vector<T> flat_, tangent_;
  T step_ = T(0);
  HalfAngle<T> pilot_{T(1), T(0)};
  std::vector<double> lane_flat_, lane_lengths_, lane_slopes_, lane_creases_mm_;
  std::vector<HalfAngle<double>> lane_creases_;
  Effort effort_;
};

template <class T>
LaneTest<T>::LaneTest(const Model& model)
    : mechanism_(model.mechanism()),
      places_(model.tests()),
      sample_deg_(model.sample_deg()),
      solver_(model, places_),
      way_per_level_(places_.empty() ? 0 : norm_of(places_.front().tangent)),
      start_(flat_state<T>(mechanism_)),
      flat_(mechanism_.diagonals.size(), T(0)),
      tangent_(mechanism_.unknowns, T(0)),
      lane_flat_(flat_.size()),
      lane_lengths_(flat_.size()),
      lane_slopes_(flat_.size()),
      lane_creases_mm_(mechanism_.creases.size()),
      lane_creases_(mechanism_.creases.size()) {
  for (const TestPlace& place : places_) {
    rounding_.push_back(
        rounding_error(std::numeric_limits<Scalar<T>>::epsilon(), model.extent(), place));
  }
}

template <class T>
template <class Work>
void LaneTest<T>::each_vector(const ShiftBlock& block, std::vector<Undecided>& open,
                              const Work& work) {
  for (std::size_t first = 0; first < open.size(); first += kLanes<T>) {
    Undecided* const sheets = open.data() + first;
    const int count = static_cast<int>(std::min<std::size_t>(kLanes<T>, open.size() - first));
    std::array<int, kLanes<T>> numbers;
    for (int i = 0; i < kLanes<T>; ++i) numbers[i] = sheets[i < count ? i : 0].sheet;
    solver_.load(block, numbers, count);
    work(sheets, count);
  }
}

template <class T>
template <class Rules>
void LaneTest<T>::run(int place, bool keeps, const ShiftBlock& block, std::vector<Undecided>& open,
                      Rules& rules, KeptStates& states, int shift_steps) {
  each_vector(block, open, [&](Undecided* sheets, int count) {
    if (shift_steps > 1) {
      solver_.solve_growing(place, shift_steps);
    } else {
      solver_.solve(place);
    }
    report_all(place, keeps, sheets, count, rules, states);
  });
}

template <class T>
template <class Rules>
void LaneTest<T>::run_again(int place, const ShiftBlock& block, std::vector<Undecided>& open,
                            Rules& rules, KeptStates& states) {
  each_vector(block, open, [&](Undecided* sheets, int count) {
    take_kept(sheets, count, states);
    solver_.solve_from(start_, place);
    report_all(place, true, sheets, count, rules, states);
  });
}

// Reads flat lengths too, in this precision. A pilot angle has not been more than twice as far from
// the base folding's as it is now.
template <class T>
template <class Rules>
void LaneTest<T>::report_all(int place, bool keeps, Undecided* open, int count, Rules& rules,
                             KeptStates& states) {
  flat_lengths(mechanism_, solver_.geometry(), flat_.data());
  for (int i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < flat_.size(); ++k) lane_flat_[k] = lane(flat_[k], i);
    rules.set_flat(open[i].sheet, lane_flat_.data());
    effort_.solves += 1;
    effort_.iterations += 2;
    const auto error = solver_.length_error(place, i);
    if (!error) continue;
    const double here_deg = pilot_deg(i), base_deg = places_[place].pilot_deg;
    if (!(here_deg > 0 && here_deg <= rules.slopes_until_deg())) continue;
    const bool goes_on = report(place, base_deg + 2 * std::abs(here_deg - base_deg), here_deg, 0,
                                open[i].sheet, i, *error, rules);
    if (keeps) {
      keep(here_deg, goes_on, rules.next_sample(here_deg), kLongestStep_deg, i, states.of(open[i]));
    }
  }
}

template <class T>
template <class Rules>
void LaneTest<T>::run_ahead(const ShiftBlock& block, std::vector<Undecided>& open, Rules& rules,
                            KeptStates& states) {
  each_vector(block, open, [&](Undecided* sheets, int count) {
    take_kept(sheets, count, states);
    solver_.solve_ahead(start_, tangent_, step_, pilot_, 0);
    for (int i = 0; i < count; ++i) {
      KeptStates::State& kept = states.of(sheets[i]);
      effort_.solves += 1;
      effort_.iterations += 3;
      const auto error = solver_.length_error_ahead(i);
      const int sample = kept.to_sample;
      const double here_deg = sample > 0 ? sample * sample_deg_ : pilot_deg(i);
      const double rate = lane(solver_.tangent().back(), i);
      const double farthest_deg = farthest_between(kept.pilot_deg, kept.tangent.back(), here_deg,
                                                   rate, lane(step_, i) / kRadPerDeg);
      const bool goes_on =
          error && report(0, farthest_deg, here_deg, sample, sheets[i].sheet, i, *error, rules);
      if (!error && sample > 0 && rules.holds_every_step()) {
        kept.to_sample = 0;  // where the pilot turns back, only the level leads on
        continue;
      }
      if (!error || (!goes_on && rate < 0 && !rules.decided(sheets[i].sheet))) {
        kept.step_deg /= 2;
        kept.to_sample = 0;
        kept.goes_on = kept.step_deg >= kShortestStep_deg;
        continue;
      }
      keep(here_deg, goes_on, rules.next_sample(here_deg), 2 * kept.step_deg, i, kept);
      if (kept.tangent.back() > 0) rules.observe(sheets[i].sheet, here_deg, kept.state);
    }
  });
}

// Empty lanes repeat the first sheet.
template <class T>
void LaneTest<T>::take_kept(Undecided* open, int count, KeptStates& states) {
  for (int i = 0; i < kLanes<T>; ++i) {
    const KeptStates::State& kept = states.of(open[i < count ? i : 0]);
    put_lane(kept.state, start_, i);
    for (std::size_t j = 0; j < tangent_.size(); ++j) {
      lane(tangent_[j], i) = static_cast<Scalar<T>>(kept.tangent[j]);
    }
    lane(step_, i) = static_cast<Scalar<T>>(kept.step_deg * kRadPerDeg * way_per_level_);
    const HalfAngle<double> pilot = half_angle_of_deg(kept.to_sample * sample_deg_);
    lane(pilot_.c, i) = static_cast<Scalar<T>>(pilot.c);
    lane(pilot_.s, i) = static_cast<Scalar<T>>(pilot.s);
  }
}

// Returns whether states beyond may tell more.
template <class T>
template <class Rules>
bool LaneTest<T>::report(int place, double farthest_deg, double pilot_deg, int sample, int sheet,
                         int i, double error, Rules& rules) {
  for (std::size_t k = 0; k < lane_lengths_.size(); ++k) {
    lane_lengths_[k] = lane(solver_.lengths()[k], i);
    lane_slopes_[k] = lane(solver_.slopes()[k], i);
  }
  const double pilot_rate = lane(solver_.tangent().back(), i);
  return rules.observe(sheet, {pilot_deg, sample, pilot_rate, farthest_deg, lane_lengths_.data(),
                               error + rounding_[place], lane_slopes_.data(),
                               slope_error(lane(solver_.slope_correction(), i)) + rounding_[place],
                               [this, i] { return creases_in_lane(i); }});
}

template <class T>
ObservedState::Creases LaneTest<T>::creases_in_lane(int i) {
  const SheetGeometry<T>& geometry = solver_.geometry();
  for (std::size_t k = 0; k < lane_creases_.size(); ++k) {
    const Crease& crease = mechanism_.creases[k];
    const double dx = lane(geometry.x[crease.b], i) - lane(geometry.x[crease.a], i);
    const double dy = lane(geometry.y[crease.b], i) - lane(geometry.y[crease.a], i);
    lane_creases_mm_[k] = std::sqrt(dx * dx + dy * dy) * mechanism_.panel_width_mm;
    const HalfAngle<T>& angle = solver_.state().creases[k];
    lane_creases_[k] = {lane(angle.c, i), lane(angle.s, i)};
  }
  return {turning_mm(lane_creases_mm_, lane_creases_),
          std::accumulate(lane_creases_mm_.begin(), lane_creases_mm_.end(), 0.0)};
}

template <class T>
void LaneTest<T>::keep(double pilot_deg, bool goes_on, int next_sample, double longest_deg, int i,
                       KeptStates::State& kept) const {
  copy_lane(solver_.state(), i, kept.state);
  for (std::size_t j = 0; j < tangent_.size(); ++j) kept.tangent[j] = lane(solver_.tangent()[j], i);
  const double length = norm_of(kept.tangent);
  for (double& rate : kept.tangent) rate /= length;
  kept.pilot_deg = pilot_deg;
  const double to_sample_deg =
      (next_sample * sample_deg_ - pilot_deg) / (way_per_level_ * kept.tangent.back());
  kept.step_deg = std::min(step_ahead_deg(pilot_deg, places_.front().pilot_deg), longest_deg);
  kept.to_sample = to_sample_deg > 0 && to_sample_deg <= kept.step_deg ? next_sample : 0;
  if (kept.to_sample > 0) kept.step_deg = to_sample_deg;
  kept.goes_on = goes_on;
}

}  // namespace misalign::solver
