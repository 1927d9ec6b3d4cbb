#include "search/splitting/level_pieces.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::search {

bool LevelPieces::add(const DrawRange& taken, PieceResult result) {
  assert(result.lo == taken.lo && result.hi <= taken.hi);
  ledger_.finish(taken, result.hi);
  if (result.hi > result.lo) done_.emplace(result.lo, std::move(result));
  return ledger_.complete();
}

PieceResult LevelPieces::all() {
  assert(ledger_.complete());
  std::size_t survivors = 0, bytes_each = 0;
  for (const auto& [lo, result] : done_) {
    survivors += result.survivors.size();
    bytes_each = std::max(bytes_each, result.there.sheets.bytes_each);
  }
  PieceResult all;
  all.survivors.reserve(survivors);
  all.there.reserve(survivors, bytes_each);
  assert(done_.empty() || done_.begin()->first == 0);
  for (auto& [lo, result] : done_) all.append(std::move(result));
  return all;
}

}  // namespace misalign::search
