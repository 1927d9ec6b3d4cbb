// Records whole histories from a path follower of any width: measures lanes together at their
// stations, then finds the sheets' miscut margins.
#pragma once

#include <array>
#include <vector>

#include "solver/records/history_observer.hpp"

namespace misalign::solver {

/// Lanes arrive at their stations one by one: the state and factors of each are kept until it
/// arrives again or its path ends; then all kept states are measured at once, with factors
/// with pivoting where the kept ones are too inaccurate.
template <class T>
class Recorder {
 public:
  /// All must outlive this object.
  Recorder(const Model& model, PathFollower<T>& follower, const StationVisitor* visit = nullptr)
      : model_(model),
        follower_(follower),
        observer_(model, lanes_of<T>(), visit),
        measure_(model) {}

  std::vector<FoldingHistory>& record(const SheetBlock& block) {
    observer_.begin(block);
    return record_waiting(block);
  }
  /// Records without quality, in two thirds of the time: residuals, singular values and isometry
  /// errors are 0.
  std::vector<FoldingHistory>& record_lengths(const SheetBlock& block) {
    looks_at_quality_ = false;
    record(block);
    looks_at_quality_ = true;
    return observer_.histories();
  }
  /// Only these sheets of the block, with their extremes; the others' histories are empty.
  std::vector<FoldingHistory>& measure(const SheetBlock& block, const std::vector<int>& sheets) {
    observer_.begin(block);
    observer_.measure_only(sheets);
    return record_waiting(block);
  }

  const Effort& effort() const { return observer_.effort(); }

  // Called by the follower.
  void begin_path(PathStart& start, int lane) {
    measure_.restart(lane);
    observer_.begin_path(start, lane);
  }
  void arrivals(const T& arrived) {
    bool again = false;
    for (int i = 0; i < kLanes<T>; ++i) again = again || lane(arrived, i) * lane(waits_, i) > 0;
    if (again) look();
    replace(arrived, follower_.state(), measure_.state());
    measure_.factors().replace(arrived, follower_.closure().factors());
  }
  bool see(const Station& station, int i) {
    stations_[i] = station;
    lane(waits_, i) = 1;
    return true;
  }
  void ended(const PathResult& path, int i) {
    if (lane(waits_, i) > 0) look();
    observer_.ended(path, i);
  }

 private:
  std::vector<FoldingHistory>& record_waiting(const SheetBlock& block) {
    follower_.run(observer_.queue(), *this);
    observer_.fall_back();
    const std::size_t all = model_.margin_samples().size();
    with_margin_.clear();
    for (int sheet = 0; all > 0 && sheet < block.sheets(); ++sheet) {
      if (observer_.histories()[sheet].margin_states.size() == all) with_margin_.push_back(sheet);
    }
    for (std::size_t first = 0; first < with_margin_.size(); first += kLanes<T>) {
      find_margins(block, first);
    }
    return observer_.histories();
  }

  MISALIGN_FLATTEN void look() {
    const SheetGeometry<T>& geometry = follower_.geometry();
    if (looks_at_quality_) {
      measure_.find_closure(geometry);
      measure_.find_condition(geometry, waits_);
    }
    measure_.find_slopes(geometry);
    const T pilot_rate = measure_.pilot_rate(), misfit = measure_.misfit();
    for (int i = 0; i < kLanes<T>; ++i) {
      if (!(lane(waits_, i) > 0)) continue;
      PathPoint& point = observer_.point();
      copy_lane(measure_.state(), i, point.state);
      if (stations_[i].pilot_deg > kPoorFactorsFrom_deg || !(lane(misfit, i) <= kLargestMisfit)) {
        observer_.see(stations_[i], i);
        continue;
      }
      measure_.copy_slopes(i, point.lengths, point.slopes);
      measure_.copy_rates(i, point.rates);
      point.pilot_rate = lane(pilot_rate, i);
      observer_.evaluate(stations_[i], i,
                         looks_at_quality_ ? measure_.quality(i) : SolveQuality{0, 0, 0});
    }
    waits_ = T(0);
  }

  // Finds the margins of the sheets from `first` on, one in each lane.
  void find_margins(const SheetBlock& block, std::size_t first) {
    std::vector<FoldingHistory>& histories = observer_.histories();
    measure_.put(block, with_margin_, first);
    measure_.margin().begin(measure_.geometry());
    for (std::size_t k = 0; k < model_.margin_samples().size(); ++k) {
      for (int i = 0; i < kLanes<T>; ++i) {
        put_lane(histories[measure_.sheet(i)].margin_states[k], measure_.state(), i);
      }
      measure_.factorize();
      measure_.margin().see(measure_.state(), measure_.factors());
    }
    for (int i = 0; i < kLanes<T>; ++i) {
      histories[measure_.sheet(i)].miscut_margin_mm = measure_.margin().mm(i);
    }
  }

  const Model& model_;
  PathFollower<T>& follower_;
  HistoryObserver observer_;
  bool looks_at_quality_ = true;
  T waits_ = T(0);           // 1: the lane's kept state has not been measured
  StateMeasure<T> measure_;  // measures the kept states
  std::array<Station, kLanes<T>> stations_{};
  std::vector<int> with_margin_;
};

}  // namespace misalign::solver
