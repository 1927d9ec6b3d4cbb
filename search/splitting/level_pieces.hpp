// Which particles of a level are done, given out and open: a pure state machine.
#pragma once

#include <map>
#include <optional>

#include "search/splitting/piece.hpp"

namespace misalign::search {

class LevelPieces {
 public:
  struct Range {
    std::uint32_t lo, hi;
  };

  /// A level whose particles lo to hi - 1 are all open.
  LevelPieces(std::uint32_t lo, std::uint32_t hi) : lo_(lo), left_(hi - lo) { open_[lo] = hi; }

  /// The next ones that are open, at most so many, now given out.
  std::optional<Range> take(std::uint32_t most);
  /// What has come back of them; what it leaves is open again. True if now all are done.
  bool add(const Range& taken, PieceResult result);
  /// All that was done, in the particles' order, once that is so.
  PieceResult all();
  std::uint32_t open() const;

 private:
  std::uint32_t lo_, left_;
  std::map<std::uint32_t, std::uint32_t> open_;  // lo -> hi
  std::map<std::uint32_t, PieceResult> done_;    // by their lo
};

}  // namespace misalign::search
