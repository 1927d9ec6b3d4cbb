// Who sees what path followers find: the judge of full paths, and the rejection test on the
// approach to the threshold. Kept outside the templates: nothing here depends on the registers.
#pragma once

#include <vector>

#include "solver/lanes/batch.hpp"
#include "solver/verdict/dense_fallback.hpp"
#include "solver/verdict/dense_state.hpp"
#include "solver/verdict/sheet_queue.hpp"

namespace misalign::solver {

/// Full paths: every sample of every sheet goes to a judge, until it has seen enough.
class JudgingObserver {
 public:
  JudgingObserver(const Model& model, int lanes);
  ~JudgingObserver();

  void begin(const SheetBlock& block);
  bool next(PathStart& start, int lane);
  PathPoint& point() { return point_; }
  bool wants_slopes() const { return model_.bump_is_fault(); }
  bool see(const Station& station, int lane);
  void ended(PathResult path, int lane);
  /// Once every path has ended: those that are for dense matrices, by dense matrices.
  void fall_back();

  const std::vector<Verdict>& verdicts() const { return verdicts_; }
  const Effort& effort() const { return effort_; }

 private:
  /// Whether the loops of this sheet are open at the point found.
  bool is_open(const SheetGeometry<double>& geometry);

  const Model& model_;
  SheetQueue queue_;
  std::vector<Judge> judges_;  // of lanes
  std::vector<Verdict> verdicts_;
  PathPoint point_;
  std::vector<double> residual_;
  DenseState dense_state_;
  DenseFallback fallback_;
  Effort effort_;
};

/// A sheet that is not decided yet, and its state kept for the approach; -1: none can be trusted.
struct OpenSheet {
  int sheet, kept_state;
};

/// The step control of the approach: a fold limit is known well enough within a tenth of a degree.
StepControlOptions approach_options();

/// The way from the last test to the threshold, of the sheets that no test has rejected.
class ApproachObserver {
 public:
  ApproachObserver(const Model& model, int lanes);
  ~ApproachObserver();

  void begin(const SheetBlock& block, RejectionTest& rejection);
  /// Room for a state at the angle of the test with this index: that of `sheet`, or a new one.
  FoldState<double>& keep(int test, OpenSheet& sheet);
  /// Hands out those that have a state kept, to be followed from it on.
  void follow(const std::vector<OpenSheet>& open) { open_ = &open; }
  bool next(PathStart& start, int lane);
  PathPoint& point() { return point_; }
  bool wants_slopes() const { return true; }
  bool see(const Station& station, int lane);
  void ended(const PathResult& path, int lane);

  const Effort& effort() const { return effort_; }

 private:
  struct Kept {
    int test;
    FoldState<double> state;
  };

  const Model& model_;
  SheetQueue queue_;
  RejectionTest* rejection_ = nullptr;
  std::vector<Kept> kept_;  // grows to what a block needs
  int kept_count_ = 0;
  const std::vector<OpenSheet>* open_ = nullptr;
  std::size_t next_ = 0;
  PathPoint point_;
  Effort effort_;
};

}  // namespace misalign::solver
