// Resolves the name of a query, or SQL.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string>

namespace misalign::schema {

struct QueryText {
  std::string sql;
  std::string name;  ///< of the query that it is; empty for SQL of somebody's own
};

/// Of a splitting search the acceptance is that of each level, with its interval. UserError (bad
/// request) for a word that names no query.
QueryText query_text(SQLite::Database& database, const std::string& name_or_sql);

/// True where a named query's LIMIT left rows out behind the `rows` that it gave.
bool leaves_rows_out(SQLite::Database& database, const std::string& named, std::uint64_t rows);

}  // namespace misalign::schema
