#include "search/splitting/level_pieces.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::search {

std::optional<LevelPieces::Range> LevelPieces::take(std::uint32_t most) {
  if (open_.empty()) return std::nullopt;
  const auto [lo, end] = *open_.begin();
  const std::uint32_t hi = std::min(end - lo, most) + lo;
  open_.erase(open_.begin());
  if (hi < end) open_[hi] = end;
  return Range{lo, hi};
}

bool LevelPieces::add(const Range& taken, PieceResult result) {
  assert(result.lo == taken.lo && result.hi <= taken.hi);
  if (result.hi < taken.hi) open_[result.hi] = taken.hi;
  if (result.hi == result.lo) return false;
  left_ -= result.hi - result.lo;
  done_.emplace(result.lo, std::move(result));
  return left_ == 0;
}

PieceResult LevelPieces::all() {
  assert(left_ == 0);
  PieceResult all;
  all.lo = all.hi = lo_;
  for (auto& [lo, result] : done_) all.append(std::move(result));
  return all;
}

std::uint32_t LevelPieces::open() const {
  std::uint32_t particles = 0;
  for (const auto& [lo, hi] : open_) particles += hi - lo;
  return particles;
}

}  // namespace misalign::search
