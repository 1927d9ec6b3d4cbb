// Keeps the pieces of a level: which particles are done, and their results.
#pragma once

#include <map>
#include <optional>

#include "search/draws/ledger.hpp"
#include "search/splitting/piece.hpp"

namespace misalign::search {

class LevelPieces {
 public:
  /// Starts a level whose `particles` are all open.
  explicit LevelPieces(std::uint32_t particles) : ledger_({0, particles}, {}) {}

  /// Gives out the next open particles, lo to hi - 1, at most `most`.
  std::optional<DrawRange> take(std::uint32_t most) { return ledger_.take(most); }
  /// Gives out these particles, done in an earlier run; false if they are not all open.
  bool take(const DrawRange& particles) { return ledger_.take(particles); }
  /// Takes the result of particles that were given out; the rest is open again. Returns true if all
  /// are done now.
  bool add(const DrawRange& taken, PieceResult result);
  /// Returns all results in the particles' order, once all are done.
  PieceResult all();
  bool anything_open() const { return ledger_.open_draws() > 0; }
  std::uint64_t open() const { return ledger_.open_draws(); }

 private:
  Ledger ledger_;
  std::map<std::uint32_t, PieceResult> done_;  // keyed by lo
};

}  // namespace misalign::search
