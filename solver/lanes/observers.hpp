// What each lane of a tracker works on, kept outside the templates: sheets waiting, their geometry,
// and who judges what their paths show.
#pragma once

#include <memory>
#include <vector>

#include "solver/continuation/homotopy.hpp"
#include "solver/continuation/path_follower.hpp"
#include "solver/continuation/path_point.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/verdict/dense_state.hpp"
#include "solver/verdict/history.hpp"

namespace misalign::solver {

/// The sheets of a block on their way to the lanes, each with the state it departs from: of the
/// base folding, or where that is too far off, found from there.
class LaneSheets {
 public:
  LaneSheets(const SheetFamily& family, int lanes);
  ~LaneSheets();

  void begin(const ShiftBlock& block);
  /// Puts the block's next sheet into this lane, to depart along the family's path; false: there is
  /// none.
  bool put_next(Departure& departure, int lane);
  /// The path of this lane's sheet has ended. False if it only lost its start, and will depart from
  /// a better one; where there is none, `path` says that it cannot fold next to flat.
  bool has_ended(PathResult& path, int lane);
  /// Puts this sheet into this lane.
  void put(int sheet, int lane);
  int of_lane(int lane) const { return sheet_of_lane_[lane]; }
  const FlatVertices& vertices_mm_of_lane(int lane);
  /// Of the sheet put last.
  const FlatVertices& vertices_mm() const { return vertices_mm_; }
  const SheetGeometry<double>& geometry() const { return geometry_; }

 private:
  const SheetFamily& family_;
  const ShiftBlock* block_ = nullptr;
  struct Found {
    int sheet;
    FoldState<double> start;
  };
  int next_ = 0;
  std::vector<int> sheet_of_lane_;
  StartFinder finder_;
  // Starts to depart from when the block's own are done; grows to what a block needs.
  std::vector<Found> found_;
  std::size_t found_count_ = 0, next_found_ = 0;
  FlatVertices vertices_mm_;
  SheetGeometry<double> geometry_;
};

/// Dense factors for the rare state that needs them: made when first asked for.
class DenseLooks {
 public:
  explicit DenseLooks(const Mechanism& mechanism);
  ~DenseLooks();
  const DenseLook& at(const FlatVertices& vertices_mm, const FoldState<double>& state);
  /// How far a state's loops are open.
  double open_by(const FlatVertices& vertices_mm, const FoldState<double>& state);

 private:
  const Mechanism& mechanism_;
  SheetGeometry<double> geometry_;
  std::vector<double> residual_;
  std::unique_ptr<DenseLook> look_;
};

/// Full paths: every sample of every sheet goes to a judge, until it has seen enough.
class JudgingDesk {
 public:
  JudgingDesk(const SheetFamily& family, int lanes);
  ~JudgingDesk();

  void begin(const ShiftBlock& block);
  bool next(Departure& departure, int lane);
  /// What is found at the stop goes here.
  StopCopy& found() { return found_; }
  bool wants_slopes() const { return family_.bump_is_fault(); }
  /// `misfit` tells what the slopes found are worth, if they are wanted.
  bool visit(const Stop& stop, int lane, double misfit);
  void ended(PathResult path, int lane);

  const std::vector<Verdict>& verdicts() const { return verdicts_; }
  const Effort& effort() const { return effort_; }

 private:
  const SheetFamily& family_;
  LaneSheets sheets_;
  std::vector<Judge> judges_;  // of lanes
  std::vector<Verdict> verdicts_;
  StopCopy found_;
  const FoldedShape shape_;
  DenseLooks dense_;
  Effort effort_;
};

/// Full paths of sheets that somebody looks at.
class RecordingDesk {
 public:
  RecordingDesk(const SheetFamily& family, int lanes);
  ~RecordingDesk();

  void begin(const ShiftBlock& block);
  bool next(Departure& departure, int lane);
  const FoldedShape& shape() const { return shape_; }
  const std::vector<int>& margin_samples() const { return options_.margin_samples; }
  Recording& of_lane(int lane) { return recordings_[lane]; }
  void ended(PathResult path, int lane);

  std::vector<FoldingHistory>& histories() { return histories_; }

 private:
  const SheetFamily& family_;
  const RecordingOptions options_;
  const FoldedShape shape_;
  LaneSheets sheets_;
  std::vector<Recording> recordings_;  // of lanes
  std::vector<FoldingHistory> histories_;
};

/// On the approach a turn of the pilot is known well enough within a tenth of a degree.
CourseOptions approach_options();

/// The way from the last test to the threshold, of the sheets that no test has rejected.
class ApproachDesk {
 public:
  ApproachDesk(const SheetFamily& family, int lanes);
  ~ApproachDesk();

  void begin(const ShiftBlock& block, Screening& screening);
  /// Room for a state at the angle of the test with this index: the place `kept`, or if that is -1
  /// a new one, whose number it becomes.
  FoldState<double>& keep(int test, int& kept);
  /// The path of `sheet` is to be followed from its kept state on.
  void add(int sheet, int kept) { waiting_.push_back({sheet, kept}); }
  bool next(Departure& departure, int lane);
  StopCopy& found() { return found_; }
  bool visit(const Stop& stop, int lane);
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

  const SheetFamily& family_;
  LaneSheets sheets_;
  Screening* screening_ = nullptr;
  std::vector<Kept> kept_;  // grows to what a block needs
  int kept_count_ = 0;
  std::vector<Work> waiting_;
  std::size_t next_ = 0;
  StopCopy found_;
  Effort effort_;
};

}  // namespace misalign::solver
