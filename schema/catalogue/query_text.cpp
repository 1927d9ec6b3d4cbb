#include "schema/catalogue/query_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/costly_terms.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/files/suggestion.hpp"

namespace misalign::schema {
namespace {

bool is_one_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  });
}

UserError no_such_query(const std::string& name) {
  // The former query `robust` ranked by the least slope, a poor predictor.
  const bool is_former = name == "robust";
  const std::string meant = is_former ? "tolerant" : nearest_word(name, named_queries());
  return UserError(Cause::bad_request, "the query was refused (" + name + " names no query" +
                                           (meant.empty() ? "" : "; did you mean " + meant + "?") +
                                           "); it must be one SELECT, or one of the names " +
                                           named_query_list());
}

std::string sql_of_name(SQLite::Database& database, const std::string& name) {
  if (name == "acceptance") {
    const CatalogueState state = read_state(database);
    if (state.ladder) return ladder_sql(*state.ladder);
  }
  return named_query(name);
}

// Unknown columns may be short names: D, thickness_mm.
bool has_unknown_column(SQLite::Database& database, const std::string& sql) {
  try {
    const SQLite::Statement statement(database, sql);
    return false;
  } catch (const SQLite::Exception& error) {
    return std::string_view(error.what()).find("no such column") != std::string_view::npos;
  }
}

}  // namespace

QueryText query_text(SQLite::Database& database, const std::string& name_or_sql) {
  const std::string named = sql_of_name(database, name_or_sql);
  if (!named.empty()) return {named, name_or_sql};
  if (is_one_word(name_or_sql)) throw no_such_query(name_or_sql);
  const std::string sql = costly_in_subqueries(name_or_sql);
  if (!has_unknown_column(database, sql)) return {sql, ""};
  return {costly_in_subqueries(in_full(name_or_sql)), ""};
}

bool leaves_rows_out(SQLite::Database& database, const std::string& named, std::uint64_t rows) {
  const LimitedQuery query = limited(named);
  if (query.most == 0 || query.most != rows) return false;
  bool more = false;
  const std::string next = fmt::format("SELECT 1 FROM ({}) LIMIT 1 OFFSET {}", query.all, rows);
  read_query(database, next, [&](const SQLite::Statement&) { more = true; });
  return more;
}

}  // namespace misalign::schema
