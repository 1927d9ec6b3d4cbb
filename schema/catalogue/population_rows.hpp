// Stores a splitting search: levels, histories of populations, hashes of sheets.
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

/// A finished piece of an unfinished population: particles lo to hi - 1 at a level.
struct PieceRow {
  std::uint32_t population, level, lo, hi;
  std::string layout;  ///< layout of the result's bytes
  std::string result;
};

/// Reads the scores of levels 1, 2, ...; empty before they are known. UserError (bad_input) if they
/// cannot belong to the catalogue's campaign.
std::vector<int> read_levels(SQLite::Database& database);
void write_levels(SQLite::Database& database, const std::vector<int>& scores, double sample_deg);
/// Reads the counts of a population from level 0 up to at most level `most_levels`. UserError
/// (bad_input) if there are none, or they do not add up.
std::vector<LevelCount> read_population(SQLite::Database& database, std::uint64_t unit,
                                        std::size_t most_levels = kMostLevels);
/// Calls `see` for each population of the ledger, in turn. UserError (bad_input) if a unit is no
/// population, or a population is in no unit.
void each_population(
    SQLite::Database& database,
    const std::function<void(const DrawRange& numbers, const std::vector<LevelCount>&)>& see);
/// Read the pieces with this layout in the order in which they were finished, without their
/// results, which may be large; and the result of one, empty if its row is damaged.
std::vector<PieceRow> read_pieces(SQLite::Database& database, const std::string& layout);
std::string read_result(SQLite::Database& database, const PieceRow& piece);
/// Writes pieces, each result with a hash of its row appended.
void write_pieces(SQLite::Database& database, const std::vector<PieceRow>& pieces);
void drop_pieces(SQLite::Database& database, std::uint32_t population);

/// Returns the hash that identifies a sheet: XXH3-128 of its displacements_mm.
std::string sheet_hash(const std::string& displacements_mm);

/// Returns the part of the digest of a population's survivors.
CandidateSum sum_of_levels(std::uint64_t unit, const std::vector<LevelCount>& levels);

/// Returns the number in this catalogue of another catalogue's candidate. It is the same, but where
/// sheets are stored it is that of the same sheet, none if that is not stored.
std::optional<std::uint64_t> number_in(SQLite::Database& into, SQLite::Database& from,
                                       std::uint64_t draw);

}  // namespace misalign::schema
