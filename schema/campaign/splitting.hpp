// Defines the search method "splitting": populations that climb from level to level.
#pragma once

#include <cstdint>
#include <vector>

#include "schema/campaign/draw_range.hpp"
#include "schema/files/input.hpp"

namespace misalign::schema {

/// A splitting search. The member initializers are released defaults and never change.
struct Splitting {
  /// Ascending; the threshold is the last. Empty: the level finder finds them.
  std::vector<double> levels_deg;
  std::uint32_t particles = 1000;      ///< number in a population, at every level
  std::uint32_t sweeps = 10;           ///< moves of each particle at a level
  std::uint32_t first_draws = 100000;  ///< plain draws at the start of a population

  bool operator==(const Splitting&) const = default;
};

inline constexpr std::uint32_t kMostParticles = 1000000, kMostSweeps = 10000,
                               kMostFirstDraws = 1000000000;
inline constexpr std::size_t kMostLevels = 256;

/// Population r has the numbers from r times this on, and its sheets have some of them: ranges,
/// units and the ledger of a splitting campaign are thus those of plain draws. A power of ten shows
/// a sheet's population in its number.
inline constexpr std::uint64_t kNumbersOfPopulation = 10'000'000'000;
/// End of the numbers of populations.
inline constexpr std::uint64_t kEndOfPopulations = kEndOfDraws / kNumbersOfPopulation;

/// Returns the range of numbers of a range of populations.
inline DrawRange numbers_of(const DrawRange& populations) {
  return {populations.lo * kNumbersOfPopulation, populations.hi * kNumbersOfPopulation};
}

/// Returns the scores of the named levels; none if the level finder must find them.
std::vector<int> named_scores(const Splitting& splitting, double sample_deg);

/// Reads the keys of splitting in the part "search" of a campaign whose threshold and samples are
/// known.
Splitting read_splitting(ObjectReader& reader, double threshold_deg, double sample_deg);
/// Checks that the request of a splitting search is not too large.
void check_splitting(ObjectReader& reader, const Splitting& splitting);

/// Returns every key of splitting alone.
Json splitting_json(const Splitting& splitting);

}  // namespace misalign::schema
