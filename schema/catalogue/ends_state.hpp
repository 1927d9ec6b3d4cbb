// Where the draws of an optimising search ended, all together and each by itself.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>
#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Of draws below the goal's end: values as the campaign's goal, none where no draw has one.
struct EndsState {
  std::string goal;
  std::uint64_t sheets, kept_as_drawn;  ///< different ones; that broke a limit, or had no value
  std::optional<double> best, median;
};

/// Within its caller's moment.
EndsState read_ends(SQLite::Database& database, std::uint64_t goal_end);

/// A candidate's row of `ascent`, every column under its name; null if there is none. In a
/// catalogue that has them.
Json read_ascent(SQLite::Database& database, std::uint64_t draw);

}  // namespace misalign::schema
