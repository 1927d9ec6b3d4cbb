// Full paths of the sheets that are worth it, seen past faults: a history in the making for each
// lane.
#pragma once

#include <memory>
#include <vector>

#include "solver/judging/close_judge.hpp"
#include "solver/judging/dense_fallback.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/model/dense_state.hpp"
#include "solver/records/history.hpp"
#include "solver/records/state_measure.hpp"

namespace misalign::solver {

/// Followed by a DenseFallback, it is an observer by itself and takes all but the state from dense
/// matrices; a follower of lanes is seen by a Recorder, which looks at all lanes together.
class HistoryObserver final : public QueueObserver {
 public:
  /// All must outlive this object.
  HistoryObserver(const Model& model, const QueueLanes& lanes,
                  const StationVisitor* visit = nullptr);
  ~HistoryObserver() override;

  void begin(const SheetBlock& block);
  /// Only these sheets of the block, and their extremes as well.
  void measure_only(const std::vector<int>& sheets);
  PathPoint& point() { return point_; }
  bool wants_slopes() const { return false; }
  /// point() from its state alone, by dense factors.
  bool see(const Station& station, int lane);
  /// The next station of this lane's path, as point() has it; past faults too.
  void evaluate(const Station& station, int lane, const SolveQuality& quality);
  /// The same, but that no judge sees it.
  void keep(const Station& station, int lane, const SolveQuality& quality);
  void ended(PathResult path, int lane);
  /// Once every path has ended: those that are for dense matrices, by dense matrices from the last
  /// station on that they reached.
  void fall_back();

  std::vector<FoldingHistory>& histories() { return histories_; }

 private:
  struct Lane {
    CloseJudge judge;
    FoldingHistory history{};
    std::vector<double> lengths_mm{}, slopes_mm_per_deg{}, angles_deg{};  // station by station
    FoldState<double> last{};                                             // at the last of them
  };
  // Of a sheet that is for dense matrices, as the first pass left it.
  struct Unfinished {
    int sheet;
    std::unique_ptr<Lane> lane;
  };

  std::unique_ptr<Lane> new_lane() {
    return std::make_unique<Lane>(Lane{CloseJudge(model_, between_)});
  }

  void begin_sheet(PathStart& start, int lane) override;
  // A sheet that was not finished takes its lane back, and begins where it was.
  bool goes_on(PathStart& start, int lane);

  const StationVisitor* visit_;
  BetweenSolver between_;
  bool finds_extremes_ = false;
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::vector<Unfinished> unfinished_;
  std::vector<FoldingHistory> histories_;
  PathPoint point_;
  FoldedShape::Points<double> points_;
  DenseState dense_state_;
  DenseFallback fallback_;
};

}  // namespace misalign::solver
