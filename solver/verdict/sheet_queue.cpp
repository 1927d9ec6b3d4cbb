#include "solver/verdict/sheet_queue.hpp"

#include <numeric>

namespace misalign::solver {

SheetBlock::~SheetBlock() = default;

SheetQueue::SheetQueue(const Model& model, int lanes) : model_(model), sheet_of_lane_(lanes) {}

SheetQueue::~SheetQueue() = default;

void SheetQueue::begin(const SheetBlock& block) {
  block_ = &block;
  waiting_.resize(static_cast<std::size_t>(block.sheets()));
  std::iota(waiting_.begin(), waiting_.end(), 0);
  next_ = found_count_ = next_found_ = 0;
}

void SheetQueue::begin_again(const std::vector<int>& sheets) {
  waiting_ = sheets;
  next_ = found_count_ = next_found_ = 0;
}

bool SheetQueue::put_next(PathStart& start, int lane) {
  const FoldState<double>* state = &model_.path().start;
  if (next_ < waiting_.size()) {
    put(waiting_[next_++], lane);
  } else if (next_found_ < found_count_) {
    const Found& found = found_[next_found_++];
    put(found.sheet, lane);
    state = &found.start;
  } else {
    return false;
  }
  start = {&geometry_, state, &model_.path(), 0, 0};
  return true;
}

bool SheetQueue::has_ended(PathResult& path, int lane) {
  if (path.end != PathEnd::start_lost) return true;
  const int sheet = sheet_of_lane_[lane];
  for (std::size_t k = 0; k < found_count_; ++k) {
    if (found_[k].sheet == sheet) return true;
  }
  if (!homotopy_) {
    homotopy_ = std::make_unique<ShiftHomotopy>(model_.mechanism(), model_.path(),
                                                model_.base().sheet.vertices_mm);
  }
  const PathEnd end = homotopy_->find(vertices_mm_of_lane(lane));
  if (end == PathEnd::fold_limit) path.end = PathEnd::fold_limit;
  if (end != PathEnd::end_reached) return true;
  if (found_count_ == found_.size()) found_.push_back({sheet, homotopy_->state()});
  Found& found = found_[found_count_++];
  found.sheet = sheet;
  found.start = homotopy_->state();
  return false;
}

void SheetQueue::put(int sheet, int lane) {
  sheet_of_lane_[lane] = sheet;
  block_->place(sheet, vertices_mm_);
  solver::place(model_.mechanism(), vertices_mm_, geometry_);
}

const FlatVertices& SheetQueue::vertices_mm_of_lane(int lane) {
  block_->place(sheet_of_lane_[lane], vertices_mm_);
  return vertices_mm_;
}

}  // namespace misalign::solver
