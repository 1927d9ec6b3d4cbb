// Observers of path followers: verdicts of full paths, of a sheet in each lane.
#pragma once

#include <vector>

#include "solver/judging/close_judge.hpp"
#include "solver/judging/function_judge.hpp"
#include "solver/judging/later_starts.hpp"
#include "solver/judging/pivoted_fallback.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/model/pivoted_state.hpp"

namespace misalign::solver {

/// Judges full paths as functions, where these are certain. Those that were in order until they
/// were lost, next to 180 degrees as a rule, can go on in close steps.
class FunctionObserver final : public QueueObserver {
 public:
  FunctionObserver(const Model& model, const QueueLanes& lanes);
  ~FunctionObserver() override;

  /// Verdicts go to `verdicts`.
  void begin(const SheetBlock& block, std::vector<Verdict>& verdicts);
  ObserverResult see(const PathFunction& function, int lane);
  void ended(PathResult path, int lane);
  const std::vector<NearState>& near_states() const { return near_states_; }

  /// The sheets that were not decided and are to be judged from flat on.
  std::vector<int>& left() { return left_; }
  /// The other sheets that were not decided, and what is known of each.
  const std::vector<QueuedStart>& later() const { return later_.starts(); }
  struct Known {
    std::vector<double> lengths;  ///< sample by sample, before the start
    int samples;                  ///< number of samples in order, some of them after the start
  };
  const Known& known(int sheet) const;

 private:
  void begin_sheet(PathStart& start, int lane) override;
  void note_start(const PathFunction& function, int lane);
  void hand_over(const PathResult& path, int lane);

  // A path that may be lost later.
  struct Lane {
    std::size_t station;  // the start of close steps; 0: none
    FoldState<double> state;
  };

  std::vector<FunctionJudge> judges_;  // of lanes
  std::vector<Lane> noted_;            // of lanes
  std::vector<Verdict>* verdicts_ = nullptr;
  std::vector<int> left_;
  LaterStarts later_;
  std::vector<Known> known_;  // in the order of later()
  std::vector<NearState> near_states_;
};

/// Judges full paths in close steps: every sample of a sheet goes to a judge, until it has seen
/// enough.
class JudgingObserver final : public QueueObserver {
 public:
  JudgingObserver(const Model& model, const QueueLanes& lanes);
  ~JudgingObserver() override;

  void begin(const SheetBlock& block);
  /// Only the paths that go on later; a sheet whose path is lost again is left.
  void only_later(FunctionObserver& functions);
  /// Only the sheets that are left.
  void only_left(FunctionObserver& functions);
  PathPoint& point() { return point_; }
  bool wants_slopes() const {
    return model_.bumps() != BumpRule::ignored || model_.criterion().asks_for_slopes();
  }
  bool see(const Station& station, int lane);
  void ended(PathResult path, int lane);
  /// Judges by PivotedFallback the paths that need it, once every path has ended.
  void fall_back();

  std::vector<Verdict>& verdicts() { return verdicts_; }

 private:
  void begin_sheet(PathStart& start, int lane) override;
  /// Returns whether the loops of this sheet are open at the observed point.
  bool is_open(const SheetGeometry<double>& geometry);

  BetweenSolver between_;
  std::vector<CloseJudge> judges_;  // of lanes
  std::vector<Verdict> verdicts_;
  PathPoint point_;
  std::vector<double> residual_;
  PivotedState pivoted_state_;
  PivotedFallback fallback_;
  FunctionObserver* functions_ = nullptr;  // while their paths go on
};

}  // namespace misalign::solver
