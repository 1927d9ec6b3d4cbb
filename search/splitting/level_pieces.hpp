// The pieces of a level: which of its particles are done, and what that gave.
#pragma once

#include <map>
#include <optional>

#include "search/draws/ledger.hpp"
#include "search/splitting/piece.hpp"

namespace misalign::search {

class LevelPieces {
 public:
  /// A level of so many particles, all open.
  explicit LevelPieces(std::uint32_t particles) : ledger_({0, particles}, {}) {}

  /// Particles lo to hi - 1, the next that are open, at most so many: now given out.
  std::optional<DrawRange> take(std::uint32_t most) { return ledger_.take(most); }
  /// These, which were done in an earlier run. False if they are not all open.
  bool take(const DrawRange& particles) { return ledger_.take(particles); }
  /// What has come back of particles that were given out; what it leaves is open again. True if now
  /// all are done.
  bool add(const DrawRange& taken, PieceResult result);
  /// All that was done, in the particles' order, once that is so.
  PieceResult all();
  bool anything_open() const { return ledger_.open_draws() > 0; }
  std::uint64_t open() const { return ledger_.open_draws(); }

 private:
  Ledger ledger_;
  std::map<std::uint32_t, PieceResult> done_;  // by their lo
};

}  // namespace misalign::search
