// A splitting search in the catalogue: levels, what became of populations, the hashes of sheets.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "schema/campaign/splitting.hpp"
#include "schema/catalogue/digest.hpp"
#include "schema/records/level_count.hpp"

namespace misalign::schema {

/// What is done of a population that is under way: particles lo to hi - 1 at a level.
struct PieceRow {
  std::uint32_t population, level, lo, hi;
  std::string layout;  ///< of the result's bytes
  std::string result;
};

/// The scores of levels 1, 2, ..., as stored; none where they are not known yet. UserError
/// (bad_input) if they can be none of the catalogue's campaign.
std::vector<int> read_levels(SQLite::Database& database);
void write_levels(SQLite::Database& database, const std::vector<int>& scores, double sample_deg);
/// What became of a population, from level 0 on, at most so many levels above. UserError
/// (bad_input) if nothing did, or it does not add up.
std::vector<LevelCount> read_population(SQLite::Database& database, std::uint64_t unit,
                                        std::size_t most_levels = kMostLevels);
/// Calls `see` for each population of the ledger, in turn. UserError (bad_input) if a unit is none,
/// or a population is in no unit.
void each_population(
    SQLite::Database& database,
    const std::function<void(const DrawRange& numbers, const std::vector<LevelCount>&)>& see);
/// All whose result has this layout, in the order in which they were done, without these results,
/// which may be large; and the result of one, empty if its row is not as it was written.
std::vector<PieceRow> read_pieces(SQLite::Database& database, const std::string& layout);
std::string read_result(SQLite::Database& database, const PieceRow& piece);
/// Each result with a hash of its row behind it.
void write_pieces(SQLite::Database& database, const std::vector<PieceRow>& pieces);
void drop_pieces(SQLite::Database& database, std::uint32_t population);

/// By which the same sheet is known again: XXH3-128 of its displacements_mm.
std::string sheet_hash(const std::string& displacements_mm);

/// The part of the digest that a population's survivors make.
CandidateSum sum_of_levels(std::uint64_t unit, const std::vector<LevelCount>& levels);

/// The number that another catalogue's candidate has in this one: its own; where sheets are stored
/// one under which the same sheet is kept, none where it is not.
std::optional<std::uint64_t> number_in(SQLite::Database& into, SQLite::Database& from,
                                       std::uint64_t draw);

}  // namespace misalign::schema
