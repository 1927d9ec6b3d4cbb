// Records of paths from a follower of any width: the paths as functions, then the states that their
// records want exactly, those of as many sheets as there are lanes side by side.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/records/record_builder.hpp"
#include "solver/records/recorder.hpp"

namespace misalign::solver {

template <class T>
class FunctionRecorder {
 public:
  /// All must outlive this object; the close follower has the last degrees of some paths.
  FunctionRecorder(const Model& model, PathFollower<T, LongSteps>& follower,
                   PathFollower<T>& close_follower)
      : model_(model),
        mechanism_(model.mechanism()),
        follower_(follower),
        close_follower_(close_follower),
        records_(model, lanes_of<T>()),
        measure_(model) {}

  /// Of every sheet of the block; says which are left for the close steps.
  const std::vector<int>& record(const SheetBlock& block) {
    records_.begin(block);
    if (model_.bumps() == BumpRule::by_cubic) {
      records_.leave_all();  // cubics between solved samples judge bumps
      return records_.left();
    }
    follower_.run(records_.queue(), records_);
    RecordBuilder::Ends ends(records_);
    close_follower_.run(records_.queue_of_ends(), ends);
    const std::vector<int>& complete = records_.complete();
    for (std::size_t first = 0; first < complete.size(); first += kLanes<T>) {
      solve_wanted(block, complete, first);
    }
    return records_.left();
  }
  /// All of the block, those that were left by their histories.
  const std::vector<PathRecord>& merge(const std::vector<FoldingHistory>& left) {
    return records_.merge(left);
  }

  const Effort& effort() const { return records_.effort(); }

 private:
  static constexpr int kMostReversalRounds = 5;

  // Of as many sheets as there are lanes, or those that are left.
  void solve_wanted(const SheetBlock& block, const std::vector<int>& sheets, std::size_t first) {
    measure_.put(block, sheets, first);
    for (int i = 0; i < kLanes<T>; ++i) measure_.restart(i);
    const int margins = static_cast<int>(model_.margin_samples().size());
    MiscutMargin<T>& margin = measure_.margin();
    if (margins > 0) margin.begin(measure_.geometry());
    for (int k = 0; k < records_.wanted_count(); ++k) {
      for (int i = 0; i < kLanes<T>; ++i) {
        const WantedState& wanted = records_.wanted(measure_.sheet(i), k);
        put_lane(wanted.near, measure_.state(), i);
        hold(wanted.pilot, i);
      }
      solve(k - margins);
      if (k < margins) margin.see(measure_.state(), measure_.factors());
      for (int i = 0; i < kLanes<T>; ++i) keep(records_.solved(i, k), i);
    }
    const std::size_t lanes = std::min<std::size_t>(kLanes<T>, sheets.size() - first);
    find_reversals(static_cast<int>(lanes));
    for (int i = 0; i < static_cast<int>(lanes); ++i) {
      records_.take(measure_.sheet(i), i, margins > 0 ? margin.mm(i) : std::nullopt);
    }
  }

  // The states of the first reversals again, until they are there; so many lanes have one.
  void find_reversals(int lanes) {
    const int reversal = records_.wanted_count() - 1;
    for (int round = 0; round < kMostReversalRounds; ++round) {
      bool any = false;
      std::array<bool, kLanes<T>> again{};
      for (int i = 0; i < lanes; ++i) {
        again[i] = records_.wants_again(measure_.sheet(i), i);
        if (!again[i]) continue;
        any = true;
        hold(records_.wanted(measure_.sheet(i), reversal).pilot, i);
      }
      if (!any) return;
      solve(static_cast<int>(Wanted::reversal));
      for (int i = 0; i < lanes; ++i) {
        if (again[i]) keep(records_.solved(i, reversal), i);
      }
    }
  }

  // Two corrections with the pilot held, or four where it may be next to a limit point, whatever
  // the neighbours need; and what is wanted of the state that they reach. For slopes three: what
  // they do not close is for the close steps.
  MISALIGN_FLATTEN void solve(int beside_margin) {
    const bool for_lengths = beside_margin == static_cast<int>(Wanted::before_least_step) ||
                             beside_margin == static_cast<int>(Wanted::after_least_step);
    const bool for_slopes = beside_margin >= static_cast<int>(Wanted::least_slope);
    measure_.correct(true);
    measure_.correct(!for_slopes);
    if (beside_margin >= static_cast<int>(Wanted::before_d)) {
      if (!for_slopes) measure_.correct(!for_lengths);
      measure_.correct(!for_lengths);
    }
    measure_.find_closure(measure_.geometry());
    measure_.find_slopes(measure_.geometry());
    if (!for_lengths && !for_slopes) measure_.find_condition(measure_.geometry());
  }

  void hold(const HalfAngle<double>& pilot, int i) {
    HalfAngle<T>& held = measure_.state().creases[mechanism_.pilot];
    lane(held.c, i) = pilot.c;
    lane(held.s, i) = pilot.s;
  }

  void keep(SolvedState& solved, int i) const {
    solved.quality = measure_.quality(i);
    measure_.copy_slopes(i, solved.lengths, solved.slopes);
  }

  const Model& model_;
  const Mechanism& mechanism_;
  PathFollower<T, LongSteps>& follower_;
  PathFollower<T>& close_follower_;
  RecordBuilder records_;
  StateMeasure<T> measure_;
};

/// Every path of the block as a function, or where that is not sure in close steps.
template <class T>
const std::vector<PathRecord>& measure_paths(const SheetBlock& block,
                                             FunctionRecorder<T>& functions,
                                             Recorder<T>& recorder) {
  const std::vector<int>& left = functions.record(block);
  return functions.merge(recorder.measure(block, left));
}

}  // namespace misalign::solver
