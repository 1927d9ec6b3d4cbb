// Defines the ladder that all populations of a campaign share: its levels and numbers of particles.
#pragma once

#include <cstdint>
#include <vector>

#include "search/splitting/piece.hpp"

namespace misalign::search {

struct Ladder {
  std::uint64_t seed;
  std::vector<int> scores;  ///< scores of levels 1, 2, ...; the last is the campaign's criterion
  std::uint32_t particles, first_draws;
  /// Number of ascents from each population, which start from the first sheets that it meets; 0:
  /// none.
  std::uint32_t starts = 0;

  std::uint32_t top() const { return static_cast<std::uint32_t>(scores.size()); }
  /// Returns the number of particles at a level; at 0 that of first draws.
  std::uint32_t size(std::uint32_t level) const { return level == 0 ? first_draws : particles; }
  int score(std::uint32_t level) const { return level == 0 ? 0 : scores[level - 1]; }
  /// Returns the level after the last one, at which particles are starts of ascents.
  std::uint32_t of_ends() const { return top() + 1; }
  /// Returns the score of the next level; above every score at the last.
  int next(std::uint32_t level) const { return level < top() ? scores[level] : kBeyondAll; }
};

/// Scores of the level that confines particles, and of the next level.
struct RungBounds {
  int within, next;
};

/// Returns the order for `particles` of a population at a level; `scored` are all particles there,
/// none at its beginning.
PieceOrder order_of(std::uint32_t population, std::uint32_t level,
                    const schema::DrawRange& particles, const RungBounds& bounds,
                    const ScoredParticles& scored);

/// Returns the survivors to copy, as ascending numbers: each equally often, and some once more,
/// chosen at random without replacement. So each has `particles` / `survivors` copies on average,
/// which keeps estimates unbiased.
std::vector<std::uint32_t> copies_of_survivors(std::uint64_t seed, std::uint32_t population,
                                               std::uint32_t level, std::uint32_t survivors,
                                               std::uint32_t particles);

}  // namespace misalign::search
