// Observes paths that are functions, one in each lane: makes their records, and requests the states
// to be solved exactly.
#pragma once

#include <vector>

#include "solver/continuation/path_follower.hpp"
#include "solver/judging/function_judge.hpp"
#include "solver/judging/later_starts.hpp"
#include "solver/judging/pivoted_fallback.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/model/model.hpp"
#include "solver/records/unfinished_record.hpp"

namespace misalign::solver {

class RecordObserver final : public QueueObserver {
 public:
  RecordObserver(const Model& model, const QueueLanes& lanes);
  ~RecordObserver() override;

  /// Returns one record for each sheet of the block, to be completed. The close follower follows
  /// the last degrees of some paths.
  template <class T>
  std::vector<UnfinishedRecord>& follow(const SheetBlock& block,
                                        PathFollower<T, LongSteps>& follower,
                                        PathFollower<T>& close_follower) {
    begin(block);
    if (model_.bumps() == BumpRule::by_cubic)
      return records_;  // cubics need solved samples: no record is certain
    follower.run(queue_, *this);
    queue_.begin_from(later_.starts());
    Ends ends{*this};
    close_follower.run(queue_, ends);
    return records_;
  }

  // The follower calls these.
  ObserverResult see(const PathFunction& function, int lane);
  void ended(PathResult path, int lane);
  /// States requested on the path just seen, and the one from which an unfinished path continues.
  const std::vector<NearState>& near_states() const { return near_states_; }

 private:
  struct Lane {
    FunctionJudge judge;
    FunctionJudge energy;  // Criterion::without_margins
    ExtremeFinder finder;
    UnfinishedRecord record{};
    const PathFunction* function = nullptr;  // set by see()
    std::size_t next = 0;                    // station
    bool fault_seen = false, energy_falls = false;
    double least_step = 0;
    std::vector<double> creases_mm{};

    bool has_reversed() const { return finder.first_reversal().diagonal >= 0; }
  };
  // Observes paths whose nodes end after the verdict but before the path: they continue in close
  // steps from the last station.
  struct Ends {
    RecordObserver& records;

    bool see(const Station&, int) { return true; }
    void ended(const PathResult& path, int lane) { records.finish(path, lane); }
  };

  void begin(const SheetBlock& block);
  void begin_sheet(PathStart& start, int lane) override;
  void go_on_later(const PathResult& path, int sheet, const PathFunction& function);
  void finish(const PathResult& path, int lane);
  ObserverResult see_energy(const PathFunction& function, Lane& lane);
  void evaluate_up_to(double end_deg, const PathFunction& function, Lane& lane);
  void note_least_step(const Station& station, Lane& lane);
  void request_d(int sample, const PathFunction& function, Lane& lane);
  void request(int k, const Station& station, const PathFunction& function, Lane& lane);
  void request(Purpose purpose, const Station& station, const PathFunction& function, Lane& lane);
  void request(Purpose purpose, double pilot_deg, double x, Lane& lane);
  const Station& station_of(int sample) const { return *samples_[sample - 1]; }

  std::vector<const Station*> samples_;  // samples of the model's path
  std::vector<Lane> lanes_;
  std::vector<UnfinishedRecord> records_;
  LaterStarts later_;
  std::vector<NearState> near_states_;
  PathFunction::Estimate estimate_;
  std::vector<HalfAngle<double>> creases_;
};

}  // namespace misalign::solver
