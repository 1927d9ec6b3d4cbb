// What a catalogue keeps of a splitting search: levels, what became of populations, and each sheet
// once.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/splitting.hpp"
#include "schema/catalogue/digest.hpp"

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

/// By which the same sheet is known again: XXH3-128 of its displacements_mm.
std::string sheet_hash(const std::string& displacements_mm);

/// The part of the digest that a population's survivors make.
CandidateSum sum_of_levels(std::uint64_t unit, const std::vector<LevelCount>& levels);

/// Of candidates that are the same sheet only the one with the least number stays, and of all no
/// more than `most`, those with the least numbers. Looks at sheets of which one lies in `added`.
/// Their units' counts and digests follow. Within a transaction; throws SQLite::Exception.
void keep_each_sheet_once(SQLite::Database& database, const DrawRange& added,
                          const std::optional<std::uint64_t>& most);

}  // namespace misalign::schema
