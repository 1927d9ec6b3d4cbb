// Observers of path followers: the judge of full paths, and the rejection test on the approach to
// the threshold. Kept outside the templates: nothing here depends on the registers.
#pragma once

#include <vector>

#include "solver/judging/close_judge.hpp"
#include "solver/judging/dense_fallback.hpp"
#include "solver/judging/function_judge.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/model/dense_state.hpp"

namespace misalign::solver {

/// Full paths as functions: what these say for certain.
class FunctionObserver final : public QueueObserver {
 public:
  FunctionObserver(const Model& model, int lanes);
  ~FunctionObserver() override;

  /// Verdicts go to `verdicts`.
  void begin(const SheetBlock& block, std::vector<Verdict>& verdicts);
  ObserverResult see(const PathFunction& function, int lane) { return judges_[lane].see(function); }
  void ended(const PathResult& path, int lane);

  /// The sheets that were not decided.
  const std::vector<int>& left() const { return left_; }

 private:
  void begin_sheet(PathStart& start, int lane) override;

  std::vector<FunctionJudge> judges_;  // of lanes
  std::vector<Verdict>* verdicts_ = nullptr;
  std::vector<int> left_;
};

/// Full paths in close steps: every sample of a sheet goes to a judge, until it has seen enough.
class JudgingObserver final : public QueueObserver {
 public:
  JudgingObserver(const Model& model, int lanes);
  ~JudgingObserver() override;

  void begin(const SheetBlock& block);
  /// Only these sheets of the block.
  void only(const std::vector<int>& sheets) { queue_.begin_again(sheets); }
  PathPoint& point() { return point_; }
  bool wants_slopes() const {
    return model_.bumps() != BumpRule::ignored || model_.criterion().asks_for_stop();
  }
  bool see(const Station& station, int lane);
  void ended(PathResult path, int lane);
  /// Once every path has ended: those that are for dense matrices, by dense matrices.
  void fall_back();

  std::vector<Verdict>& verdicts() { return verdicts_; }

 private:
  void begin_sheet(PathStart& start, int lane) override;
  /// Whether the loops of this sheet are open at the point found.
  bool is_open(const SheetGeometry<double>& geometry);

  BetweenSolver between_;
  std::vector<CloseJudge> judges_;  // of lanes
  std::vector<Verdict> verdicts_;
  PathPoint point_;
  std::vector<double> residual_;
  DenseState dense_state_;
  DenseFallback fallback_;
};

/// A sheet that is not decided yet, and its state kept for the approach; -1: none can be trusted.
struct Undecided {
  int sheet, kept_state;
};

/// The step control of the approach: a fold limit is known well enough within a tenth of a degree.
CloseStepOptions approach_options();

/// The way from the last test to the threshold, of the sheets that no test has rejected.
class ApproachObserver {
 public:
  ApproachObserver(const Model& model, int lanes);
  ~ApproachObserver();

  void begin(const SheetBlock& block, RejectionTest& rejection);
  /// A state of a sheet, and the rates of its unknowns with the pilot where they are known.
  struct Kept {
    const TestAngle* angle;
    FoldState<double> state;
    std::vector<double> rates;
  };
  /// The one of this sheet, or room for it.
  Kept& keep(Undecided& sheet);
  bool is_kept_at(const TestAngle& angle, const Undecided& sheet) const {
    return sheet.kept_state >= 0 && kept_[sheet.kept_state].angle == &angle;
  }
  /// Those that have a state kept, to be followed from it on.
  SheetQueue& queue_of(const std::vector<Undecided>& open);
  PathPoint& point() { return point_; }
  bool wants_slopes() const { return true; }
  bool see(const Station& station, int lane);
  void ended(const PathResult& path, int lane);

  const Effort& effort() const { return effort_; }

 private:
  const Model& model_;
  SheetQueue queue_;
  RejectionTest* rejection_ = nullptr;
  std::vector<Kept> kept_;  // grows to what a block needs
  int kept_count_ = 0;
  std::vector<QueuedStart> starts_;
  PathPoint point_;
  Effort effort_;
};

}  // namespace misalign::solver
