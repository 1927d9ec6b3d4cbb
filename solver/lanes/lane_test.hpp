// Rejection tests: as many sheets as there are lanes, all at one angle (an AngleSolver).
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "solver/lanes/angle_solver.hpp"
#include "solver/lanes/observers.hpp"

namespace misalign::solver {

/// Looks at open sheets at an angle and tells `rules` what it sees (a RejectionTest). Of the sheets
/// that are not decided then, `approach` keeps a state that can be trusted (an ApproachObserver).
template <class T>
class LaneTest {
 public:
  /// `model` and `angles` must outlive this object.
  LaneTest(const Model& model, const std::vector<TestAngle>& angles);

  /// From the base folding. States replace those that are kept only if `is_departure`.
  template <class Rules, class Approach>
  void run(int angle, bool is_departure, const ShiftBlock& block, std::vector<Undecided>& open,
           Rules& rules, Approach& approach);
  /// Once more from states kept at this angle, which every sheet has: what another precision left
  /// in doubt.
  template <class Rules, class Approach>
  void run_again(int angle, const ShiftBlock& block, std::vector<Undecided>& open, Rules& rules,
                 Approach& approach);
  /// From states kept at the angle before, which every sheet has, and along their rates.
  template <class Rules, class Approach>
  void run_ahead(int angle, const ShiftBlock& block, std::vector<Undecided>& open, Rules& rules,
                 Approach& approach);

  const Effort& effort() const { return effort_; }

 private:
  template <class Work>
  void each_vector(const ShiftBlock& block, std::vector<Undecided>& open, const Work& work);
  template <class Approach>
  void take_kept(Undecided* open, int count, Approach& approach);
  template <class Rules, class Approach>
  void report_all(int angle, bool replaces, Undecided* open, int count, Rules& rules,
                  Approach& approach);
  template <class Rules>
  bool report(int angle, int sheet, int i, std::optional<double> error, Rules& rules);
  template <class Kept>
  void keep(int angle, int i, Kept& kept) const;

  const Mechanism& mechanism_;
  const std::vector<TestAngle>& angles_;
  AngleSolver<T> solver_;
  std::vector<double> rounding_;  // per angle
  FoldState<T> start_;
  std::vector<T> flat_, rates_;
  std::vector<double> lane_flat_, lane_lengths_, lane_slopes_;
  Effort effort_;
};

template <class T>
LaneTest<T>::LaneTest(const Model& model, const std::vector<TestAngle>& angles)
    : mechanism_(model.mechanism()),
      angles_(angles),
      solver_(model, angles),
      start_(flat_state<T>(mechanism_)),
      flat_(mechanism_.diagonals.size(), T(0)),
      rates_(mechanism_.unknowns, T(0)),
      lane_flat_(flat_.size()),
      lane_lengths_(flat_.size()),
      lane_slopes_(flat_.size()) {
  for (const TestAngle& angle : angles) {
    rounding_.push_back(
        rounding_error(std::numeric_limits<Scalar<T>>::epsilon(), model.extent(), angle));
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
template <class Rules, class Approach>
void LaneTest<T>::run(int angle, bool is_departure, const ShiftBlock& block,
                      std::vector<Undecided>& open, Rules& rules, Approach& approach) {
  each_vector(block, open, [&](Undecided* sheets, int count) {
    solver_.solve(angle);
    report_all(angle, is_departure, sheets, count, rules, approach);
  });
}

template <class T>
template <class Rules, class Approach>
void LaneTest<T>::run_again(int angle, const ShiftBlock& block, std::vector<Undecided>& open,
                            Rules& rules, Approach& approach) {
  each_vector(block, open, [&](Undecided* sheets, int count) {
    take_kept(sheets, count, approach);
    solver_.solve_from(start_, angle);
    report_all(angle, true, sheets, count, rules, approach);
  });
}

// Flat lengths too, in this precision.
template <class T>
template <class Rules, class Approach>
void LaneTest<T>::report_all(int angle, bool replaces, Undecided* open, int count, Rules& rules,
                             Approach& approach) {
  flat_lengths(mechanism_, solver_.geometry(), flat_.data());
  for (int i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < flat_.size(); ++k) lane_flat_[k] = lane(flat_[k], i);
    rules.set_flat(open[i].sheet, lane_flat_.data());
    if (report(angle, open[i].sheet, i, solver_.length_error(angle, i), rules) &&
        (replaces || open[i].kept_state < 0)) {
      keep(angle, i, approach.keep(open[i]));
    }
  }
}

template <class T>
template <class Rules, class Approach>
void LaneTest<T>::run_ahead(int angle, const ShiftBlock& block, std::vector<Undecided>& open,
                            Rules& rules, Approach& approach) {
  each_vector(block, open, [&](Undecided* sheets, int count) {
    take_kept(sheets, count, approach);
    const double by_rad =
        2 * half_sine_between(angles_[angle].pilot, approach.keep(sheets[0]).angle->pilot);
    solver_.solve_ahead(start_, rates_, by_rad, angle);
    for (int i = 0; i < count; ++i) {
      const auto error = solver_.length_error_ahead(angle, i);
      if (!report(angle, sheets[i].sheet, i, error, rules)) continue;
      auto& kept = approach.keep(sheets[i]);
      keep(angle, i, kept);
      rules.observe(sheets[i].sheet, angles_[angle].sample, kept.state);
    }
  });
}

// Empty lanes repeat the first sheet.
template <class T>
template <class Approach>
void LaneTest<T>::take_kept(Undecided* open, int count, Approach& approach) {
  for (int i = 0; i < kLanes<T>; ++i) {
    const auto& kept = approach.keep(open[i < count ? i : 0]);
    put_lane(kept.state, start_, i);
    for (std::size_t j = 0; j < rates_.size(); ++j) {
      lane(rates_[j], i) = static_cast<Scalar<T>>(kept.rates[j]);
    }
  }
}

// Whether the state can be trusted and the sheet is still open.
template <class T>
template <class Rules>
bool LaneTest<T>::report(int angle, int sheet, int i, std::optional<double> error, Rules& rules) {
  const TestAngle& at = angles_[angle];
  effort_.solves += 1;
  effort_.iterations += at.with_slopes ? 2 : 1;
  if (!error) return false;
  for (std::size_t k = 0; k < lane_lengths_.size(); ++k) {
    lane_lengths_[k] = lane(solver_.lengths()[k], i);
    lane_slopes_[k] = lane(solver_.slopes()[k], i);
  }
  rules.observe(sheet, {at.sample, lane_lengths_.data(), *error + rounding_[angle],
                        at.with_slopes ? lane_slopes_.data() : nullptr,
                        slope_error(lane(solver_.slope_correction(), i)) + rounding_[angle]});
  return !rules.decided(sheet);
}

template <class T>
template <class Kept>
void LaneTest<T>::keep(int angle, int i, Kept& kept) const {
  kept.angle = &angles_[angle];
  copy_lane(solver_.state(), i, kept.state);
  if (!angles_[angle].with_slopes) return;
  for (std::size_t j = 0; j < rates_.size(); ++j) kept.rates[j] = lane(solver_.rates()[j], i);
}

}  // namespace misalign::solver
