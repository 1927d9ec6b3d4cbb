// Reads the optima of an optimising search, all together and each alone.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>
#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Totals of the draws below the goal's end; values of the campaign's objective, or distances from
/// its shape, none if no draw has one.
struct EndsState {
  std::string goal;
  std::uint64_t sheets, kept_as_drawn;  ///< different sheets; starts without an ascent
  std::optional<double> best, median;
};

/// Reads the totals, within the caller's transaction.
EndsState read_ends(SQLite::Database& database, std::uint64_t goal_end);

/// Returns a candidate's row of `ascent` by the names of its columns; null without a row. The
/// catalogue must have that table.
Json read_ascent(SQLite::Database& database, std::uint64_t draw);

}  // namespace misalign::schema
