// Full paths of the sheets that are worth it, seen past faults: one recording for each lane.
#pragma once

#include <vector>

#include "solver/verdict/dense_fallback.hpp"
#include "solver/verdict/dense_state.hpp"
#include "solver/verdict/history.hpp"
#include "solver/verdict/sheet_queue.hpp"

namespace misalign::solver {

/// Followed by a DenseFallback, it is an observer by itself and takes all but the state from dense
/// matrices; for a follower of lanes there is LaneRecorder, which looks at all lanes together.
class RecordingObserver {
 public:
  RecordingObserver(const Model& model, int lanes, const StationVisitor* visit = nullptr);
  ~RecordingObserver();

  void begin(const SheetBlock& block);
  bool next(PathStart& start, int lane);
  PathPoint& point() { return point_; }
  bool wants_slopes() const { return false; }
  /// point() from its state alone, by dense factors.
  bool see(const Station& station, int lane);
  /// What was found of this lane's sheet.
  Recording& of_lane(int lane) { return recordings_[lane]; }
  void ended(PathResult path, int lane);
  /// Once every path has ended: those that are for dense matrices, by dense matrices.
  void fall_back() { fallback_.run(queue_, *this); }

  std::vector<FoldingHistory>& histories() { return histories_; }

 private:
  const Model& model_;
  SheetQueue queue_;
  std::vector<Recording> recordings_;  // of lanes
  std::vector<FoldingHistory> histories_;
  PathPoint point_;
  SheetGeometry<double> geometry_;
  FoldedPoints<double> points_;
  DenseState dense_state_;
  DenseFallback fallback_;
};

}  // namespace misalign::solver
