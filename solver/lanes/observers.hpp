// Who sees what path followers find: the judge of full paths, and the rejection test on the
// approach to the threshold. Kept outside the templates: nothing here depends on the registers.
#pragma once

#include <vector>

#include "solver/lanes/batch.hpp"
#include "solver/verdict/dense_fallback.hpp"
#include "solver/verdict/dense_state.hpp"
#include "solver/verdict/sheet_queue.hpp"

namespace misalign::solver {

/// The sheets of a block of shifts.
class ShiftedSheets final : public SheetBlock {
 public:
  explicit ShiftedSheets(const Model& model);
  ~ShiftedSheets() override;
  /// These ones; `block` must live as long as they are asked for.
  const SheetBlock& of(const ShiftBlock& block);
  int sheets() const override;
  void place(int sheet, FlatVertices& vertices_mm) const override;

 private:
  const Model& model_;
  const ShiftBlock* block_ = nullptr;
};

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
  void fall_back() { fallback_.run(queue_, *this); }

  const std::vector<Verdict>& verdicts() const { return verdicts_; }
  const Effort& effort() const { return effort_; }

 private:
  /// Whether the loops of the sheet in geometry_ are open at the point found.
  bool is_open();

  const Model& model_;
  SheetQueue queue_;
  std::vector<Judge> judges_;  // of lanes
  std::vector<Verdict> verdicts_;
  PathPoint point_;
  std::vector<double> residual_;
  SheetGeometry<double> geometry_;
  DenseState dense_state_;
  DenseFallback fallback_;
  Effort effort_;
};

/// The step control of the approach: a fold limit is known well enough within a tenth of a degree.
StepControlOptions approach_options();

/// The way from the last test to the threshold, of the sheets that no test has rejected.
class ApproachObserver {
 public:
  ApproachObserver(const Model& model, int lanes);
  ~ApproachObserver();

  void begin(const SheetBlock& block, RejectionTest& rejection);
  /// Room for a state at the angle of the test with this index: the place `kept`, or if that is -1
  /// a new one, whose number it becomes.
  FoldState<double>& keep(int test, int& kept);
  /// The path of `sheet` is to be followed from its kept state on.
  void add(int sheet, int kept) { waiting_.push_back({sheet, kept}); }
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
  struct Work {
    int sheet, kept;
  };

  const Model& model_;
  SheetQueue queue_;
  RejectionTest* rejection_ = nullptr;
  std::vector<Kept> kept_;  // grows to what a block needs
  int kept_count_ = 0;
  std::vector<Work> waiting_;
  std::size_t next_ = 0;
  PathPoint point_;
  Effort effort_;
};

}  // namespace misalign::solver
