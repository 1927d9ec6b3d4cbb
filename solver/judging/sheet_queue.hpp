// Hands the sheets of a block to the lanes of a path follower.
#pragma once

#include <memory>
#include <vector>

#include "solver/continuation/homotopy.hpp"
#include "solver/model/model.hpp"

namespace misalign::solver {

/// Sheets numbered from 0: a model's with these shifts, or the one with these vertices. Its
/// arguments must outlive it.
class SheetBlock {
 public:
  SheetBlock(const Model& model, const ShiftBlock& shifts);
  explicit SheetBlock(const FlatVertices& vertices_mm);

  int sheets() const;
  void place(int sheet, FlatVertices& vertices_mm) const;

 private:
  const Model* model_ = nullptr;
  const ShiftBlock* shifts_ = nullptr;
  const FlatVertices* vertices_mm_ = nullptr;
};

/// Places the vertices of one sheet of a block.
class PlacedSheet {
 public:
  /// `mechanism` must outlive this object.
  explicit PlacedSheet(const Mechanism& mechanism);
  ~PlacedSheet();

  /// Geometry of a sheet, valid until the next call.
  const SheetGeometry<double>& of(const SheetBlock& block, int sheet);

 private:
  const Mechanism& mechanism_;
  FlatVertices vertices_mm_;
  SheetGeometry<double> geometry_;
};

/// A sheet of a block with the start of its path on a plan; all must outlive the path.
struct QueuedStart {
  int sheet;
  const FoldState<double>* state;
  const PathPlan* plan;
  std::size_t first_station;
  int forward_sign;
};

/// Number of a queue's lanes, and the maker of its finder of starts.
struct QueueLanes {
  std::size_t count;
  std::unique_ptr<StartFinder> (*make_finder)(const Model& model);
};
template <class T>
QueueLanes lanes_of() {
  return {kLanes<T>, [](const Model& model) -> std::unique_ptr<StartFinder> {
            return std::make_unique<ShiftHomotopy<T>>(model.mechanism(), model.elimination(),
                                                      model.path(), model.base().sheet.vertices_mm);
          }};
}

/// Hands out sheets in turn, each with its starting state: that of the base folding, or if that is
/// too far off one that a homotopy finds.
class SheetQueue {
 public:
  SheetQueue(const Model& model, const QueueLanes& lanes);
  ~SheetQueue();

  /// `block` must live until its paths have ended.
  void begin(const SheetBlock& block);
  /// Hands out only these sheets again; known starts and failures are kept.
  void begin_again(const std::vector<int>& sheets);
  /// Hands out only these sheets, from their given states.
  void begin_from(const std::vector<QueuedStart>& starts);
  /// Puts the next sheet into this lane, on the model's path unless another start is given; returns
  /// false if there is none.
  bool next(PathStart& start, int lane);
  /// Takes the end of the path in this lane. Returns false if it only lost its start and is queued
  /// again for a better one; if there is none, `path` becomes a fold limit next to flat.
  bool has_ended(PathResult& path, int lane);
  int of_lane(int lane) const { return sheet_of_lane_[lane]; }
  /// Geometry of the sheet in this lane, valid until the next call.
  const SheetGeometry<double>& geometry_of_lane(int lane);

 private:
  const Model& model_;
  const QueueLanes lanes_;
  const SheetBlock* block_ = nullptr;
  std::vector<int> waiting_;
  const std::vector<QueuedStart>* starts_ = nullptr;  // given starts, if not on the model's path
  std::size_t next_ = 0;
  std::vector<int> sheet_of_lane_;
  const StartFinder::FarStart* far_start(int sheet) const;
  void look_for_starts();
  std::unique_ptr<StartFinder> finder_;  // made when first needed
  // Sheets for which the base folding is too far off, those already sought first; kept at its
  // largest size.
  std::vector<StartFinder::FarStart> far_;
  std::size_t far_count_ = 0, looked_for_ = 0;
  PlacedSheet placed_;
};

/// Observes paths of a queue's sheets.
class QueueObserver {
 public:
  virtual ~QueueObserver();

  SheetQueue& queue() { return queue_; }
  const Effort& effort() const { return effort_; }

  /// Called by the follower when a sheet of the queue is put into this lane.
  void begin_path(PathStart& start, int lane);

 protected:
  QueueObserver(const Model& model, const QueueLanes& lanes);
  /// Begins a sheet; flat_ has the lengths of its diagonals (panel widths).
  virtual void begin_sheet(PathStart& start, int lane) = 0;

  const Model& model_;
  SheetQueue queue_;
  std::vector<double> flat_;
  Effort effort_;
};

}  // namespace misalign::solver
