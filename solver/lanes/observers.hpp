// Observers of path followers: the judges of full paths. Nothing here depends on the registers, and
// so nothing is a template.
#pragma once

#include <vector>

#include "solver/judging/close_judge.hpp"
#include "solver/judging/function_judge.hpp"
#include "solver/judging/pivoted_fallback.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/model/pivoted_state.hpp"

namespace misalign::solver {

/// Judges full paths as functions, where these are certain.
class FunctionObserver final : public QueueObserver {
 public:
  FunctionObserver(const Model& model, const QueueLanes& lanes);
  ~FunctionObserver() override;

  /// Verdicts go to `verdicts`.
  void begin(const SheetBlock& block, std::vector<Verdict>& verdicts);
  ObserverResult see(const PathFunction& function, int lane) { return judges_[lane].see(function); }
  void ended(PathResult path, int lane);

  /// The sheets that were not decided.
  const std::vector<int>& left() const { return left_; }

 private:
  void begin_sheet(PathStart& start, int lane) override;

  std::vector<FunctionJudge> judges_;  // of lanes
  std::vector<Verdict>* verdicts_ = nullptr;
  std::vector<int> left_;
};

/// Judges full paths in close steps: every sample of a sheet goes to a judge, until it has seen
/// enough.
class JudgingObserver final : public QueueObserver {
 public:
  JudgingObserver(const Model& model, const QueueLanes& lanes);
  ~JudgingObserver() override;

  void begin(const SheetBlock& block);
  /// Only these sheets of the block.
  void only(const std::vector<int>& sheets) { queue_.begin_again(sheets); }
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
};

}  // namespace misalign::solver
