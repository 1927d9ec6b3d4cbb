#include "solver/judging/sheet_queue.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {

SheetBlock::SheetBlock(const Model& model, const ShiftBlock& shifts)
    : model_(&model), shifts_(&shifts) {}

SheetBlock::SheetBlock(const FlatVertices& vertices_mm) : vertices_mm_(&vertices_mm) {}

int SheetBlock::sheets() const { return shifts_ ? shifts_->sheets : 1; }

void SheetBlock::place(int sheet, FlatVertices& vertices_mm) const {
  if (vertices_mm_) {
    vertices_mm = *vertices_mm_;
  } else {
    assert(sheet >= 0 && sheet < shifts_->sheets);
    assert(shifts_->shifts_mm.size() >=
           static_cast<std::size_t>(shifts_->sheets) * 2 * model_->shifted().size());
    model_->displace(shifts_->of(sheet), vertices_mm);
  }
}

PlacedSheet::PlacedSheet(const Mechanism& mechanism) : mechanism_(mechanism) {}

PlacedSheet::~PlacedSheet() = default;

const SheetGeometry<double>& PlacedSheet::of(const SheetBlock& block, int sheet) {
  block.place(sheet, vertices_mm_);
  place(mechanism_, vertices_mm_, geometry_);
  return geometry_;
}

SheetQueue::SheetQueue(const Model& model, const QueueLanes& lanes)
    : model_(model), lanes_(lanes), sheet_of_lane_(lanes.count), placed_(model.mechanism()) {}

SheetQueue::~SheetQueue() = default;

void SheetQueue::begin(const SheetBlock& block) {
  block_ = &block;
  waiting_.resize(static_cast<std::size_t>(block.sheets()));
  std::iota(waiting_.begin(), waiting_.end(), 0);
  starts_ = nullptr;
  next_ = far_count_ = looked_for_ = 0;
}

void SheetQueue::begin_again(const std::vector<int>& sheets) {
  assert(block_);  // begun before
  waiting_ = sheets;
  starts_ = nullptr;
  next_ = 0;
}

void SheetQueue::begin_from(const std::vector<QueuedStart>& starts) {
  assert(block_);
  starts_ = &starts;
  next_ = 0;
}

bool SheetQueue::next(PathStart& start, int lane) {
  assert(block_ && lane >= 0 && static_cast<std::size_t>(lane) < sheet_of_lane_.size());
  if (!starts_ && next_ == waiting_.size()) look_for_starts();
  if (next_ == (starts_ ? starts_->size() : waiting_.size())) return false;
  const QueuedStart* const from = starts_ ? &(*starts_)[next_] : nullptr;
  sheet_of_lane_[lane] = from ? from->sheet : waiting_[next_];
  ++next_;
  const SheetGeometry<double>& geometry = geometry_of_lane(lane);
  if (from) {
    start = {&geometry, from->state, from->plan, from->first_station, from->forward_sign};
    return true;
  }
  const StartFinder::FarStart* const far = far_start(of_lane(lane));
  const bool is_found = far && far->end == PathEnd::end_reached;
  start = {&geometry, is_found ? &far->state : &model_.path().start, &model_.path(), 0, 0};
  return true;
}

bool SheetQueue::has_ended(PathResult& path, int lane) {
  if (path.end != PathEnd::start_lost) return true;
  const int sheet = of_lane(lane);
  if (const StartFinder::FarStart* const far = far_start(sheet)) {
    if (far->end == PathEnd::fold_limit) path.end = PathEnd::fold_limit;
    return true;
  }
  if (far_count_ == far_.size()) far_.emplace_back(model_.mechanism());
  StartFinder::FarStart& far = far_[far_count_++];
  far.sheet = sheet;
  far.geometry = placed_.of(*block_, sheet);
  return false;
}

const StartFinder::FarStart* SheetQueue::far_start(int sheet) const {
  const auto end = far_.begin() + static_cast<std::ptrdiff_t>(looked_for_);
  const auto at = std::find_if(
      far_.begin(), end, [&](const StartFinder::FarStart& start) { return start.sheet == sheet; });
  return at == end ? nullptr : &*at;
}

// Finds starts for all sheets lost since the last call, and queues them again.
void SheetQueue::look_for_starts() {
  if (looked_for_ == far_count_) return;
  if (!finder_) finder_ = lanes_.make_finder(model_);
  const std::span<StartFinder::FarStart> lost(far_.data() + looked_for_, far_count_ - looked_for_);
  finder_->find(lost);
  for (const StartFinder::FarStart& far : lost) waiting_.push_back(far.sheet);
  looked_for_ = far_count_;
}

const SheetGeometry<double>& SheetQueue::geometry_of_lane(int lane) {
  assert(of_lane(lane) >= 0 && of_lane(lane) < block_->sheets());
  return placed_.of(*block_, of_lane(lane));
}

QueueObserver::QueueObserver(const Model& model, const QueueLanes& lanes)
    : model_(model), queue_(model, lanes), flat_(model.mechanism().diagonals.size()) {}

QueueObserver::~QueueObserver() = default;

void QueueObserver::begin_path(PathStart& start, int lane) {
  flat_lengths(model_.mechanism(), *start.geometry, flat_.data());
  begin_sheet(start, lane);
}

}  // namespace misalign::solver
