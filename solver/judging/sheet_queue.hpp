// The sheets of a block on their way to the lanes of a path follower.
#pragma once

#include <memory>
#include <vector>

#include "solver/continuation/homotopy.hpp"
#include "solver/model/model.hpp"

namespace misalign::solver {

/// Sheets by their number from 0 on: a model's with these shifts, or the one with these vertices.
/// What it is made from must outlive it.
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

/// Where the vertices of one sheet of a block lie.
class PlacedSheet {
 public:
  /// `mechanism` must outlive this object.
  explicit PlacedSheet(const Mechanism& mechanism);
  ~PlacedSheet();

  /// Until another one is asked for.
  const SheetGeometry<double>& of(const SheetBlock& block, int sheet);

 private:
  const Mechanism& mechanism_;
  FlatVertices vertices_mm_;
  SheetGeometry<double> geometry_;
};

/// A sheet of a block, and where on a plan its path is to begin; all must outlive the path.
struct QueuedStart {
  int sheet;
  const FoldState<double>* state;
  const PathPlan* plan;
  std::size_t first_station;
  int forward_sign;
};

/// How many lanes a queue's sheets go to, and what finds starts in as many at a time.
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

/// Hands out sheets one after the other, each with the state it starts from: of the base folding,
/// or where that is too far off, found from there.
class SheetQueue {
 public:
  SheetQueue(const Model& model, const QueueLanes& lanes);
  ~SheetQueue();

  /// `block` must live until its paths have ended.
  void begin(const SheetBlock& block);
  /// Only these of the block once more; starts that were found, and known failures, are kept.
  void begin_again(const std::vector<int>& sheets);
  /// Only these of the block, from states of their own.
  void begin_from(const std::vector<QueuedStart>& starts);
  /// Puts the next sheet into this lane, to start along the model's path if none else is said;
  /// false: there is none.
  bool next(PathStart& start, int lane);
  /// The path of this lane's sheet has ended. False if it only lost its start, and will go again
  /// once better ones have been looked for; where there is none, `path` says then that it cannot
  /// fold next to flat.
  bool has_ended(PathResult& path, int lane);
  int of_lane(int lane) const { return sheet_of_lane_[lane]; }
  /// Of the sheet in this lane, until another one is asked for.
  const SheetGeometry<double>& geometry_of_lane(int lane);

 private:
  const Model& model_;
  const QueueLanes lanes_;
  const SheetBlock* block_ = nullptr;
  std::vector<int> waiting_;
  const std::vector<QueuedStart>* starts_ = nullptr;  // of those, if not along the model's path
  std::size_t next_ = 0;
  std::vector<int> sheet_of_lane_;
  const StartFinder::FarStart* far_start(int sheet) const;
  void look_for_starts();
  std::unique_ptr<StartFinder> finder_;  // made when first needed
  // Sheets that the base folding was too far off for, those that were looked for first; grows to
  // what a block needs.
  std::vector<StartFinder::FarStart> far_;
  std::size_t far_count_ = 0, looked_for_ = 0;
  PlacedSheet placed_;
};

/// An observer of paths that takes its sheets from a queue.
class QueueObserver {
 public:
  virtual ~QueueObserver();

  SheetQueue& queue() { return queue_; }
  const Effort& effort() const { return effort_; }

  /// For the follower: a sheet of the queue has been put into this lane.
  void begin_path(PathStart& start, int lane);

 protected:
  QueueObserver(const Model& model, const QueueLanes& lanes);
  /// flat_ has the lengths of its diagonals (panel widths).
  virtual void begin_sheet(PathStart& start, int lane) = 0;

  const Model& model_;
  SheetQueue queue_;
  std::vector<double> flat_;
  Effort effort_;
};

}  // namespace misalign::solver
