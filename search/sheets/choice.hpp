// Chooses candidates by --draw, --best, --where, --by and --diverse.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/catalogue/database.hpp"

namespace misalign::search {

struct Choice {
  std::vector<std::uint64_t> draws;  ///< these, if there are any; the rest does not matter then
  std::optional<std::uint64_t> best;
  std::optional<std::uint64_t> diverse;
  std::optional<std::string> by;  ///< column that says what is best, before the order of `best`
  std::string where;              ///< SQL condition on the candidates view

  /// Whether anything but --by was said.
  bool chooses() const { return !draws.empty() || best || diverse || !where.empty(); }
};

/// How many of the best are looked at for a spread.
inline constexpr std::uint64_t kDiverseAmong = 1000;

/// The SELECT of these columns of the candidates that `where` lets through, the best first, at most
/// as many as `best` says. UserError (bad_request) if there is no such condition or column.
std::string best_sql(SQLite::Database& database, const std::string& columns, const Choice& choice);

/// A word of the candidates as a column of a SELECT: "thickness_mm(draw, 140) AS thickness_mm".
/// UserError (bad_request, by this parameter) for any other.
std::string column_sql(SQLite::Database& database, const std::string& word,
                       const std::string& parameter = "columns");

/// The draws that are chosen: those named, in their order; the best first, of those that `where`
/// lets through; or all of those. Diverse ones are a spread (farthest first, from the best one on)
/// over the shifts and over what the diagonals do of it, among the best kDiverseAmong. UserError
/// (2) if there are none, or it is no condition or column.
std::vector<std::uint64_t> chosen_draws(SQLite::Database& database, const Choice& choice);

/// The options that were given, as a shell takes them: " --best 3 --where 'stroke_max < 0.05'".
std::string text_of(const Choice& choice);

}  // namespace misalign::search
