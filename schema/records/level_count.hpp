// Counts the particles of a splitting search's population, level by level.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Counts of a population at one level; at level 0 of its first draws.
struct LevelCount {
  std::uint32_t level;
  std::uint32_t particles;
  std::uint32_t survivors;                ///< particles that reached the next level
  std::uint32_t ancestors;                ///< first draws from which survivors descend
  std::uint64_t tried, taken, undecided;  ///< draws or moves; those that stayed within the level
  std::uint64_t met;                      ///< different sheets that meet the criterion
  double seconds;
};

/// Calls `see` with each count, except time, in which two records of one population differ: "level
/// 2, met". Null where one of them lacks that level.
void each_difference(
    const std::vector<LevelCount>& a, const std::vector<LevelCount>& b,
    const std::function<void(const std::string& count, const Json& a, const Json& b)>& see);

/// Returns the population's unbiased estimate of the share of draws that reach this level: the
/// product of the survival shares before. 0 if it died before.
double share_reaching(std::uint32_t level, const std::vector<LevelCount>& levels);

}  // namespace misalign::schema
