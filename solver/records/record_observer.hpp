// Observes paths that are functions, one in each lane: what their records say, and the states to be
// solved exactly.
#pragma once

#include <deque>
#include <vector>

#include "solver/continuation/path_follower.hpp"
#include "solver/judging/dense_fallback.hpp"
#include "solver/judging/function_judge.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/model/model.hpp"
#include "solver/records/unfinished_record.hpp"

namespace misalign::solver {

class RecordObserver final : public QueueObserver {
 public:
  RecordObserver(const Model& model, const QueueLanes& lanes);
  ~RecordObserver() override;

  /// One for each sheet of the block, to be changed as they are completed. The close follower has
  /// the last degrees of some paths.
  template <class T>
  std::vector<UnfinishedRecord>& follow(const SheetBlock& block,
                                        PathFollower<T, LongSteps>& follower,
                                        PathFollower<T>& close_follower) {
    begin(block);
    if (model_.bumps() == BumpRule::by_cubic) return records_;  // of solved samples: none is sure
    follower.run(queue_, *this);
    queue_.begin_from(ends_);
    Ends ends{*this};
    close_follower.run(queue_, ends);
    return records_;
  }

  // The follower calls these.
  ObserverResult see(const PathFunction& function, int lane);
  void ended(PathResult path, int lane);
  /// The states that were requested of the path that was just seen, and where it goes on if it is
  /// unfinished.
  const std::vector<NearState>& near_states() const { return near_states_; }

 private:
  struct Lane {
    FunctionJudge judge;
    ExtremeFinder finder;
    UnfinishedRecord record{};
    const PathFunction* function = nullptr;  // once it was seen
    std::size_t next = 0;                    // station
    bool fault_seen = false;
    double least_step = 0;

    bool has_reversed() const { return finder.first_reversal().diagonal >= 0; }
  };
  // Paths whose nodes ended after the verdict, but before the path did: in close steps, from the
  // last station before.
  struct Ends {
    RecordObserver& records;

    bool see(const Station&, int) { return true; }
    void ended(const PathResult& path, int lane) { records.finish(path, lane); }
  };

  void begin(const SheetBlock& block);
  void begin_sheet(PathStart& start, int lane) override;
  void go_on_later(const PathResult& path, int sheet, const PathFunction& function);
  void finish(const PathResult& path, int lane);
  void evaluate_up_to(double end_deg, const PathFunction& function, Lane& lane);
  void note_least_step(const Station& station, Lane& lane);
  void request_d(int sample, const PathFunction& function, Lane& lane);
  void request(int k, const Station& station, const PathFunction& function, Lane& lane);
  void request(Purpose purpose, const Station& station, const PathFunction& function, Lane& lane);
  void request(Purpose purpose, double pilot_deg, double x, Lane& lane);
  const Station& station_of(int sample) const { return *samples_[sample - 1]; }

  std::vector<const Station*> samples_;  // of the model's path
  std::vector<Lane> lanes_;
  std::vector<UnfinishedRecord> records_;
  std::vector<QueuedStart> ends_;
  std::deque<FoldState<double>> ends_near_;  // their states, which stay where they are
  std::vector<NearState> near_states_;
  PathFunction::Estimate here_;
  const FoldState<double> near_;  // of the size that a state has
};

}  // namespace misalign::solver
