// The ladder that all populations of a campaign share: its levels, and how many particles climb
// them.
#pragma once

#include <cstdint>
#include <vector>

#include "search/splitting/piece.hpp"

namespace misalign::search {

struct Ladder {
  std::uint64_t seed;
  std::vector<int> scores;  ///< of levels 1, 2, ...; the last is the campaign's criterion
  std::uint32_t particles, first_draws;
  /// So many of the sheets that a population meets first go on to their ends; 0: all stay.
  std::uint32_t starts = 0;

  std::uint32_t top() const { return static_cast<std::uint32_t>(scores.size()); }
  /// How many there are at a level; at 0 the first draws.
  std::uint32_t size(std::uint32_t level) const { return level == 0 ? first_draws : particles; }
  int score(std::uint32_t level) const { return level == 0 ? 0 : scores[level - 1]; }
  /// The level behind the last one, at which particles are starts on the way to their ends.
  std::uint32_t of_ends() const { return top() + 1; }
  /// The score that ends this level; above every score at the last.
  int next(std::uint32_t level) const { return level < top() ? scores[level] : kBeyondAll; }
};

/// The levels that particles are confined to, and on the watch for.
struct RungBounds {
  int within, next;
};

/// Of a population's particles at a level, those of `here`; at its beginning none.
PieceOrder order_of(std::uint32_t population, std::uint32_t level,
                    const schema::DrawRange& particles, const RungBounds& bounds,
                    const ScoredParticles& here);

/// Who is copied where so few have survived: each of them as often as any other, and some once
/// more, chosen by chance without replacement. So each has `particles` / `survivors` copies on
/// average, which keeps estimates unbiased. Numbers of survivors, ascending.
std::vector<std::uint32_t> copies_of_survivors(std::uint64_t seed, std::uint32_t population,
                                               std::uint32_t level, std::uint32_t survivors,
                                               std::uint32_t particles);

}  // namespace misalign::search
