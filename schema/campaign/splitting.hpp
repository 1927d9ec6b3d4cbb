// The search method "splitting": populations that climb from level to level.
#pragma once

#include <cstdint>
#include <vector>

#include "schema/campaign/draw_range.hpp"
#include "schema/files/input.hpp"

namespace misalign::schema {

/// A splitting search. The member initializers are the released defaults: they never change.
struct Splitting {
  /// Ascending; the threshold is the last. Empty: found by a level finder.
  std::vector<double> levels_deg;
  std::uint32_t particles = 1000;      ///< of a population, at every level
  std::uint32_t sweeps = 10;           ///< moves of each particle at a level
  std::uint32_t first_draws = 100000;  ///< plain draws that a population begins with

  bool operator==(const Splitting&) const = default;
};

inline constexpr std::uint32_t kMostParticles = 1000000, kMostSweeps = 10000,
                               kMostFirstDraws = 1000000000;
inline constexpr std::size_t kMostLevels = 256;

/// Population r has the numbers from r times this on, and its sheets have some of them: so ranges,
/// units and the ledger of a splitting campaign are those of plain draws. A power of ten, so that
/// people can tell a sheet's population from its number.
inline constexpr std::uint64_t kNumbersOfPopulation = 10'000'000'000;
/// Populations are numbered below this.
inline constexpr std::uint64_t kEndOfPopulations = kEndOfDraws / kNumbersOfPopulation;

/// The range of numbers of a range of populations.
inline DrawRange numbers_of(const DrawRange& populations) {
  return {populations.lo * kNumbersOfPopulation, populations.hi * kNumbersOfPopulation};
}

/// The scores of the levels that it names; none if a level finder is to find them.
std::vector<int> named_scores(const Splitting& splitting, double sample_deg);

/// Reads its keys of the part "search" of a campaign whose threshold and samples are known.
Splitting read_splitting(ObjectReader& reader, double threshold_deg, double sample_deg);
/// What a splitting that is asked for has too much of.
void check_splitting(ObjectReader& reader, const Splitting& splitting);

/// Every key of its own.
Json splitting_json(const Splitting& splitting);

}  // namespace misalign::schema
