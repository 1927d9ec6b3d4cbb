// Counts of what became of a population of a splitting search, level by level.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// What became of a population at one level; at level 0 of its first draws.
struct LevelCount {
  std::uint32_t level;
  std::uint32_t particles;
  std::uint32_t survivors;                ///< that have reached the next level
  std::uint32_t ancestors;                ///< first draws from which these descend
  std::uint64_t tried, taken, undecided;  ///< draws or moves; those that stayed within the level
  std::uint64_t met;                      ///< different sheets that meet the criterion
  double seconds;
};

/// Calls `see` with each count in which two accounts of one population differ, all but its time:
/// "level 2, met". Null where one of them has not come to that level.
void each_difference(
    const std::vector<LevelCount>& a, const std::vector<LevelCount>& b,
    const std::function<void(const std::string& count, const Json& a, const Json& b)>& see);

/// Its estimate of the share of draws that reach this level: the product of what survived before. 0
/// if it died on the way. Unbiased.
double share_reaching(std::uint32_t level, const std::vector<LevelCount>& levels);

}  // namespace misalign::schema
