#include "search/sheets/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "schema/catalogue/candidate_words.hpp"
#include "schema/catalogue/costly_terms.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/catalogue/sql_tokens.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/files/suggestion.hpp"
#include "search/sheets/farthest_first.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/terminal/shell_word.hpp"

namespace misalign::search {
namespace {

using schema::Json;

// Names the unknown column or function in SQLite's words about a condition.
std::string unknown_column(const std::string& refused, const std::vector<std::string>& columns) {
  const auto& [kind, typed] = schema::unknown_word_of(refused);
  if (!kind) return "";
  return " (" + typed + " is no " + kind + schema::column_meant(typed, columns) + ")";
}

std::vector<std::uint64_t> draws_of(SQLite::Database& database, const std::string& sql) {
  std::vector<std::uint64_t> draws;
  look_ahead(database, sql);
  schema::read_query(database, sql, [&](const SQLite::Statement& row) {
    const SQLite::Column draw = row.getColumn(0);
    if (!draw.isInteger() || draw.getInt64() < 0) {
      throw schema::damaged(database, "a candidate's draw is " + schema::text_of(draw));
    }
    draws.push_back(schema::draw_of(draw));
  });
  return draws;
}

// Stored values in which candidates differ.
struct Differences {
  Json displacements_mm, elongation;
};

Json json_of(const SQLite::Column& column) {
  return column.isText() ? schema::json_of(schema::text_of(column)) : Json();
}

// Rows of unequal length and meaning made comparable: each coordinate over its standard deviation,
// divided so that the whole block counts like one coordinate.
Eigen::MatrixXd standardized(const std::vector<std::vector<double>>& points) {
  const auto rows = static_cast<Eigen::Index>(points.front().size());
  Eigen::MatrixXd block(rows, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    block.col(static_cast<Eigen::Index>(k)) = Eigen::VectorXd::Map(points[k].data(), rows);
  }
  block.colwise() -= Eigen::VectorXd(block.rowwise().mean());
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double deviation =
        std::sqrt(block.row(row).squaredNorm() / static_cast<double>(block.cols()));
    if (deviation > 0) block.row(row) /= deviation * std::sqrt(static_cast<double>(rows));
  }
  return block;
}

// Elongations of the diagonals at D, one list per candidate.
std::vector<std::vector<double>> elongations_of(const SQLite::Database& database,
                                                const std::vector<Differences>& candidates) {
  std::vector<std::vector<double>> elongations;
  for (const Differences& candidate : candidates) {
    const Json& list = candidate.elongation;
    const bool numbers = list.is_array() && !list.empty() &&
                         std::all_of(list.begin(), list.end(), std::mem_fn(&Json::is_number));
    if (!numbers || (!elongations.empty() && elongations[0].size() != list.size())) {
      throw schema::damaged(database, "a candidate's elongations are none");
    }
    elongations.push_back(list.get<std::vector<double>>());
  }
  return elongations;
}

// Shifts of every vertex that any of them shifts, x and y, one list per candidate.
std::vector<std::vector<double>> shifts_of(const SQLite::Database& database,
                                           const std::vector<Differences>& candidates) {
  std::map<std::string, std::size_t> place;  // of a vertex in the lists
  for (const Differences& candidate : candidates) {
    if (!candidate.displacements_mm.is_object()) {
      throw schema::damaged(database, "a candidate's displacements are none");
    }
    for (const auto& [label, shift] : candidate.displacements_mm.items()) {
      if (!shift.is_array() || shift.size() != 2 || !shift[0].is_number() ||
          !shift[1].is_number()) {
        throw schema::damaged(database, "a candidate's displacement is " + shift.dump());
      }
      place.emplace(label, place.size());
    }
  }
  std::vector<std::vector<double>> shifts;
  for (const Differences& candidate : candidates) {
    shifts.emplace_back(2 * place.size(), 0.0);
    for (const auto& [label, shift] : candidate.displacements_mm.items()) {
      shifts.back()[2 * place[label]] = shift[0].get<double>();
      shifts.back()[2 * place[label] + 1] = shift[1].get<double>();
    }
  }
  return shifts;
}

// Points of the candidates for a spread, a column for each: shifts and elongations, of equal
// weight.
Eigen::MatrixXd places_of(const SQLite::Database& database,
                          const std::vector<Differences>& candidates) {
  const Eigen::MatrixXd shifts = standardized(shifts_of(database, candidates));
  const Eigen::MatrixXd elongations = standardized(elongations_of(database, candidates));
  Eigen::MatrixXd places(shifts.rows() + elongations.rows(), shifts.cols());
  places << shifts, elongations;
  return places;
}

// Reads the rows of these draws, in their order.
std::vector<Differences> differences_of(SQLite::Database& database,
                                        const std::vector<std::uint64_t>& draws) {
  std::map<std::uint64_t, Differences> found;
  const std::string sql =
      fmt::format("SELECT draw, displacements_mm, elongation FROM candidate WHERE draw IN ({})",
                  fmt::join(draws, ", "));
  schema::read_query(database, sql, [&](const SQLite::Statement& row) {
    found[schema::draw_of(row.getColumn(0))] = {json_of(row.getColumn(1)),
                                                json_of(row.getColumn(2))};
  });
  std::vector<Differences> ordered;
  for (const std::uint64_t draw : draws) {
    const auto row = found.find(draw);
    if (row == found.end()) {
      throw schema::damaged(database, "draw " + std::to_string(draw) + " has no row");
    }
    ordered.push_back(row->second);
  }
  return ordered;
}

// Checks that the condition is a complete expression: it selects among candidates, and errors are
// about the condition, not about a query around it.
void check_condition(SQLite::Database& database, const Choice& choice) {
  const std::string where = schema::in_full(choice.where);
  const auto refuse = [&](const std::string& why) {
    throw schema::UserError(
        solver::OptionFault{"where", choice.where,
                            fmt::format("is no condition on the columns {}, or {} of a draw{}",
                                        fmt::join(schema::columns_of_candidates(database), ", "),
                                        fmt::join(schema::study_functions(), ", "), why),
                            "try \"stroke_max < 0.08\""});
  };
  const std::string reason = schema::reason_not_to_enclose(where);
  if (!reason.empty()) refuse(" (" + reason + ")");
  try {
    // The brackets check its end, the operator its beginning.
    for (const std::string& condition : {"(" + where + "\n)", "0 OR " + where + "\n"}) {
      draws_of(database, "SELECT draw FROM candidates WHERE " + condition + " LIMIT 0");
    }
  } catch (const schema::UserError& error) {
    if (error.cause() != schema::Cause::bad_request) throw;
    refuse(unknown_column(error.what(), schema::columns_of_candidates(database)));
  }
}

// A column; or a function of the draw, from the design's angle of use or from this one:
// "thickness_mm", "thickness_mm(draw)", "thickness_mm(draw, 140)".
bool is_word_of_candidates(const std::string& typed, const std::vector<std::string>& columns) {
  const std::vector<std::string> tokens = schema::sql_tokens(schema::in_full(typed)).tokens;
  if (tokens.size() == 1) return std::ranges::find(columns, tokens[0]) != columns.end();
  if (tokens.size() < 4 || !schema::study_column(tokens[0])) return false;
  const auto is_number = [](const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789.") == std::string::npos;
  };
  return tokens[1] == "(" && tokens[2] == "draw" && tokens.back() == ")" &&
         (tokens.size() == 4 || (tokens.size() == 6 && tokens[3] == "," && is_number(tokens[4])));
}

void check_column(SQLite::Database& database, const Choice& choice) {
  const std::string& column = *choice.by;
  const std::vector<std::string> columns = schema::columns_of_candidates(database);
  if (is_word_of_candidates(column, columns)) return;
  throw schema::UserError(solver::OptionFault{
      "by", column,
      "is no column of a candidate" +
          schema::column_meant(column.substr(0, column.find('(')), columns),
      fmt::format("choose one of {}", fmt::join(schema::words_of_candidates(columns), ", "))});
}

// Orders as "best" does, or by a column, the largest first, and the best first among equals.
std::string order_of(const std::optional<std::string>& column) {
  const std::string best = schema::best_order(), head = "ORDER BY ";
  return column ? head + schema::in_full(*column) + " DESC, " + best.substr(head.size()) : best;
}

// Selects all candidates that satisfy `where`, in no order.
std::string all_sql(SQLite::Database& database, const std::string& columns, const Choice& choice) {
  if (!choice.where.empty()) check_condition(database, choice);
  return "SELECT " + columns + " FROM candidates" +
         (choice.where.empty() ? ""
                               : " WHERE (" + schema::costly_last(schema::in_full(choice.where)) +
                                     "\n)");  // which ends a comment
}

std::vector<std::uint64_t> chosen(SQLite::Database& database, const Choice& choice) {
  if (!choice.draws.empty()) {
    std::vector<std::uint64_t> draws;
    for (const std::uint64_t draw : choice.draws) {
      const std::string sql = "SELECT draw FROM candidate WHERE draw = " + std::to_string(draw);
      if (!draws_of(database, sql).empty()) draws.push_back(draw);
    }
    return draws;
  }
  if (!choice.best && !choice.diverse) {
    return draws_of(database, all_sql(database, "draw", choice) + " ORDER BY draw");
  }
  if (choice.best) return draws_of(database, best_sql(database, "draw", choice));
  Choice best = choice;
  best.best = kDiverseAmong;
  const std::vector<std::uint64_t> among = draws_of(database, best_sql(database, "draw", best));
  if (among.empty()) return {};
  const Eigen::MatrixXd places = places_of(database, differences_of(database, among));
  std::vector<std::uint64_t> spread;
  for (const int k : farthest_first(places, *choice.diverse)) {
    spread.push_back(among[static_cast<std::size_t>(k)]);
  }
  return spread;
}

}  // namespace

std::string column_sql(SQLite::Database& database, const std::string& word,
                       const std::string& parameter) {
  const std::vector<std::string> columns = schema::columns_of_candidates(database);
  const std::string name = word.substr(0, word.find('('));
  if (!is_word_of_candidates(word, columns)) {
    throw schema::UserError(solver::OptionFault{
        parameter, word,
        "is no column or function of a candidate" + schema::column_meant(name, columns),
        fmt::format("choose one of {}", fmt::join(schema::words_of_candidates(columns), ", "))});
  }
  return schema::in_full(word) + " AS \"" + word + "\"";
}

std::string best_sql(SQLite::Database& database, const std::string& columns, const Choice& choice) {
  std::string sql = all_sql(database, columns, choice);
  if (choice.by) check_column(database, choice);
  sql += " " + order_of(choice.by);
  if (choice.best) sql += " LIMIT " + std::to_string(*choice.best);
  return sql;
}

std::vector<std::uint64_t> chosen_draws(SQLite::Database& database, const Choice& choice) {
  const std::vector<std::uint64_t> draws = chosen(database, choice);
  if (draws.empty() || (!choice.draws.empty() && draws.size() < choice.draws.size())) {
    throw schema::UserError(schema::Cause::bad_request,
                            database.getFilename() + ": holds no such candidate; `misalign query " +
                                database.getFilename() +
                                " best` shows those that it holds, `misalign replay` any draw");
  }
  return draws;
}

std::string text_of(const Choice& choice) {
  std::string text;
  if (choice.best) text += " --best " + std::to_string(*choice.best);
  if (choice.diverse) text += " --diverse " + std::to_string(*choice.diverse);
  if (choice.by) text += " --by " + shell_word(*choice.by);
  if (!choice.where.empty()) text += " --where " + shell_word(choice.where);
  return text;
}

}  // namespace misalign::search
