// Writes the rows of a query for people (aligned), programs (JSON) and spreadsheets (CSV).
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::schema {

enum class TableStyle { aligned, json, csv };

/// Takes a table's text piece by piece; false if no more is wanted.
using TextSink = std::function<bool(const std::string& part)>;

/// Runs one read-only statement and gives its rows on as they come, with bounded memory; how many
/// there were. The first line of an aligned table, and of CSV, names the columns, and is a piece of
/// its own. The columns of an aligned table are as wide as its first rows need (1,000, or what
/// comes within a second): wider cells behind them widen their columns from there on. UserError
/// (bad_request) if it is no SQL, not a single statement, or more than a query; see storage_failure
/// for what can happen to the file.
std::uint64_t write_query(SQLite::Database& database, const std::string& sql, TableStyle style,
                          const TextSink& sink);

/// Takes a row, at which the statement stands.
using RowReader = std::function<void(const SQLite::Statement& row)>;

/// The same, and gives the rows themselves on. UserError as above.
void read_query(SQLite::Database& database, const std::string& sql, const RowReader& read);

/// The names of the columns that it gives, each once: a second "draw" is "draw_2". UserError as
/// above.
std::vector<std::string> query_columns(SQLite::Database& database, const std::string& sql);

/// The whole of a small table.
std::string query_table(SQLite::Database& database, const std::string& sql, TableStyle style);

/// The rows of one of this program's own queries: a list of {column: value}, where a text that is
/// no UTF-8 is made such. UserError (bad_input).
Json query_rows(SQLite::Database& database, const std::string& sql);
/// The row of a draw in one of this program's own tables; null if there is none.
Json row_of_draw(SQLite::Database& database, const std::string& table, std::uint64_t draw);

}  // namespace misalign::schema
