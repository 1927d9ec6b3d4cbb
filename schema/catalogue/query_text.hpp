// Resolves the name of a query, or SQL.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string>

namespace misalign::schema {

struct QueryText {
  std::string sql;
  std::string name;  ///< name of the query; empty for other SQL
};

/// Resolves a query's name, or SQL. The query acceptance of a splitting search lists each level
/// with its interval. UserError (bad request) for a word that names no query.
QueryText query_text(SQLite::Database& database, const std::string& name_or_sql);

/// Returns whether a named query's LIMIT left rows out after the `rows` that it gave.
bool leaves_rows_out(SQLite::Database& database, const std::string& named, std::uint64_t rows);

}  // namespace misalign::schema
