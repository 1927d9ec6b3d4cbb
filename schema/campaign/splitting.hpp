// How a splitting search is done: populations of sheets that climb from level to level.
#pragma once

#include <cstdint>
#include <vector>

namespace misalign::schema {

/// The member initializers are the released defaults: they never change.
struct Splitting {
  /// Ascending, the threshold last. Empty: found by a pilot.
  std::vector<double> levels_deg;
  std::uint32_t particles = 1000;      ///< of a population, at every level
  std::uint32_t sweeps = 10;           ///< moves of each particle at a level
  std::uint32_t first_draws = 100000;  ///< plain draws that a population begins with

  bool operator==(const Splitting&) const = default;
};

inline constexpr std::uint32_t kMostParticles = 1000000, kMostSweeps = 10000,
                               kMostFirstDraws = 1000000000;
/// Populations of a campaign are numbered below this.
inline constexpr std::uint64_t kEndOfPopulations = std::uint64_t{1} << 32;

}  // namespace misalign::schema
