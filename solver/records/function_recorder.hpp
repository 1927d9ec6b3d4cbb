// Records paths by a follower of any width: as functions, then by the states that their records
// request, for one sheet in each lane.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "solver/records/record_observer.hpp"
#include "solver/records/recorder.hpp"

namespace misalign::solver {

template <class T>
class FunctionRecorder {
 public:
  /// All must outlive this object. The close follower follows the last degrees of some paths, the
  /// recorder paths that are uncertain as functions.
  FunctionRecorder(const Model& model, PathFollower<T, LongSteps>& follower,
                   PathFollower<T>& close_follower, Recorder<T>& recorder)
      : model_(model),
        mechanism_(model.mechanism()),
        follower_(follower),
        close_follower_(close_follower),
        recorder_(recorder),
        observer_(model, lanes_of<T>()),
        measure_(model),
        solved_(model, kLanes<T>) {}

  /// Records every sheet of the block.
  const std::vector<PathRecord>& record(const SheetBlock& block) {
    std::vector<UnfinishedRecord>& made = observer_.follow(block, follower_, close_follower_);
    find_incomplete(made, incomplete_);
    for (std::size_t first = 0; first < incomplete_.size(); first += kLanes<T>) {
      complete_from(first, block, made);
    }
    find_unsure(made, unsure_);
    merge(made, recorder_.measure(block, unsure_), mechanism_, records_);
    return records_;
  }

  const Effort& effort() const { return observer_.effort(); }

 private:
  static constexpr int kMostReversalRounds = 5;

  // Completes the incomplete sheets from `first` on, one in each lane.
  void complete_from(std::size_t first, const SheetBlock& block,
                     std::vector<UnfinishedRecord>& records) {
    measure_.put(block, incomplete_, first);
    std::array<UnfinishedRecord*, kLanes<T>> made;
    for (int i = 0; i < kLanes<T>; ++i) {
      measure_.restart(i);
      made[i] = &records[static_cast<std::size_t>(measure_.sheet(i))];
    }
    const int margins = static_cast<int>(model_.margin_samples().size());
    MiscutMargin<T>& margin = measure_.margin();
    if (margins > 0) margin.begin(measure_.geometry());
    for (int k = 0; k < margins + kPurposes; ++k) {
      for (int i = 0; i < kLanes<T>; ++i) {
        const RequestedState& requested = made[i]->requested[k];
        put_lane(requested.near, measure_.state(), i);
        hold(requested.pilot, i);
      }
      solve(k - margins);
      if (k < margins) margin.see(measure_.state(), measure_.factors());
      for (int i = 0; i < kLanes<T>; ++i) keep(solved_[i][static_cast<std::size_t>(k)], i);
    }
    const int lanes =
        static_cast<int>(std::min<std::size_t>(kLanes<T>, incomplete_.size() - first));
    find_reversals(made, lanes);
    for (int i = 0; i < lanes; ++i) {
      complete(*made[i], solved_[i], margins > 0 ? margin.mm(i) : std::nullopt);
    }
  }

  // Solves the states of the first reversals until they converge; only the first `lanes` lanes have
  // a sheet.
  void find_reversals(const std::array<UnfinishedRecord*, kLanes<T>>& made, int lanes) {
    for (int round = 0; round < kMostReversalRounds; ++round) {
      bool any = false;
      std::array<bool, kLanes<T>> again{};
      for (int i = 0; i < lanes; ++i) {
        const auto next_deg = made[i]->slopes.next_reversal_deg(solved_[i].back().slopes);
        again[i] = next_deg.has_value();
        if (!next_deg) continue;
        any = true;
        made[i]->requested.move_pilot(Purpose::reversal, *next_deg);
        hold(made[i]->requested.of(Purpose::reversal).pilot, i);
      }
      if (!any) return;
      solve(static_cast<int>(Purpose::reversal));
      for (int i = 0; i < lanes; ++i) {
        if (again[i]) keep(solved_[i].back(), i);
      }
    }
  }

  // Makes two corrections with the pilot held, three for slopes, four where it may be next to a
  // limit point, and finds the requested results. States that stay open are left to close steps.
  MISALIGN_FLATTEN void solve(int purpose) {
    const bool for_lengths = purpose == static_cast<int>(Purpose::before_least_step) ||
                             purpose == static_cast<int>(Purpose::after_least_step);
    const bool for_slopes = purpose >= static_cast<int>(Purpose::least_slope);
    measure_.correct(true);
    measure_.correct(!for_slopes);
    if (purpose >= static_cast<int>(Purpose::before_d)) {
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
  Recorder<T>& recorder_;
  RecordObserver observer_;
  StateMeasure<T> measure_;
  SolvedStates solved_;
  std::vector<int> incomplete_, unsure_;
  std::vector<PathRecord> records_;
};

}  // namespace misalign::solver
