// Observes full paths beyond faults and makes a history in each lane.
#pragma once

#include <memory>
#include <vector>

#include "solver/judging/close_judge.hpp"
#include "solver/judging/pivoted_fallback.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/model/pivoted_state.hpp"
#include "solver/records/history.hpp"
#include "solver/records/state_measure.hpp"

namespace misalign::solver {

/// A PivotedFallback's follower observes with it directly, and it takes all but the state from
/// factors with pivoting; a follower of lanes is observed by a Recorder, for all lanes together.
class HistoryObserver final : public QueueObserver {
 public:
  /// All must outlive this object.
  HistoryObserver(const Model& model, const QueueLanes& lanes,
                  const StationVisitor* visit = nullptr);
  ~HistoryObserver() override;

  void begin(const SheetBlock& block);
  /// Restricts it to these sheets of the block, and requests their extremes.
  void measure_only(const std::vector<int>& sheets);
  PathPoint& point() { return point_; }
  bool wants_slopes() const { return false; }
  /// Completes point() from its state, by factors with pivoting.
  bool see(const Station& station, int lane);
  /// Judges and keeps the next station of this lane's path in point(), also beyond faults.
  void evaluate(const Station& station, int lane, const SolveQuality& quality);
  /// Keeps a station without judging it.
  void keep(const Station& station, int lane, const SolveQuality& quality);
  void ended(PathResult path, int lane);
  /// Follows the paths that are for PivotedFallback from their last station, once every path has
  /// ended.
  void fall_back();

  std::vector<FoldingHistory>& histories() { return histories_; }

 private:
  struct Lane {
    CloseJudge judge;
    Judge energy;  // Criterion::without_margins
    FoldingHistory history{};
    std::vector<double> creases_mm{};
    std::vector<double> lengths_mm{}, slopes_mm_per_deg{}, angles_deg{};  // station by station
    FoldState<double> last{};  // state at the last station
  };
  // A sheet for PivotedFallback, as the first pass left it.
  struct Unfinished {
    int sheet;
    std::unique_ptr<Lane> lane;
  };

  std::unique_ptr<Lane> new_lane() {
    return std::make_unique<Lane>(
        Lane{CloseJudge(model_, between_),
             Judge(model_.mechanism(), model_.criterion().without_margins())});
  }

  void begin_sheet(PathStart& start, int lane) override;
  // Restores the lane of an unfinished sheet, which begins at its last station.
  bool goes_on(PathStart& start, int lane);

  const StationVisitor* visit_;
  BetweenSolver between_;
  bool finds_extremes_ = false;
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::vector<Unfinished> unfinished_;
  std::vector<FoldingHistory> histories_;
  PathPoint point_;
  FoldedShape::Points<double> points_;
  PivotedState pivoted_state_;
  PivotedFallback fallback_;
};

}  // namespace misalign::solver
