// Chooses candidates by --draw, --best, --where, --by and --diverse.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/catalogue/database.hpp"

namespace misalign::search {

struct Choice {
  std::vector<std::uint64_t> draws;  ///< these alone, if there are any
  std::optional<std::uint64_t> best;
  std::optional<std::uint64_t> diverse;
  std::optional<std::string> by;  ///< column to sort by, before the order of `best`
  std::string where;              ///< SQL condition on the candidates view

  /// Returns whether any option but --by is given.
  bool chooses() const { return !draws.empty() || best || diverse || !where.empty(); }
};

/// The number of best candidates among which a spread is chosen.
inline constexpr std::uint64_t kDiverseAmong = 1000;

/// The SELECT of these columns of the candidates that satisfy `where`, the best first, at most
/// `best` of them. UserError (bad_request) if there is no such condition or column.
std::string best_sql(SQLite::Database& database, const std::string& columns, const Choice& choice);

/// A word of the candidates as a column of a SELECT: "thickness_mm(draw, 140) AS thickness_mm".
/// UserError (bad_request, by this parameter) for any other.
std::string column_sql(SQLite::Database& database, const std::string& word,
                       const std::string& parameter = "columns");

/// The chosen draws: those named, in their order; or of those that satisfy `where` the best, or
/// all. Diverse ones are a spread (farthest first, from the best on) over shifts and elongations,
/// among the best kDiverseAmong. UserError (2) if there are none, or for no condition or column.
std::vector<std::uint64_t> chosen_draws(SQLite::Database& database, const Choice& choice);

/// The options that were given, as a shell takes them: " --best 3 --where 'stroke_max < 0.05'".
std::string text_of(const Choice& choice);

}  // namespace misalign::search
