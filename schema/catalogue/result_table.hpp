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

/// Runs one read-only statement and writes its rows as they come, with bounded memory; returns
/// their number. The first line of an aligned table, and of CSV, names the columns, and is a piece
/// of its own. The columns of an aligned table are as wide as its first rows need (1,000, or those
/// within a second); wider cells later widen their columns. UserError (bad_request) if it is no
/// SQL, not a single statement, or not a query; see storage_failure for failures of the file.
std::uint64_t write_query(SQLite::Database& database, const std::string& sql, TableStyle style,
                          const TextSink& sink);

/// Receives a statement at its present row.
using RowReader = std::function<void(const SQLite::Statement& row)>;

/// Runs one read-only statement and calls `read` for each row. UserError as above.
void read_query(SQLite::Database& database, const std::string& sql, const RowReader& read);

/// Returns the distinct names of a query's columns: a second "draw" is "draw_2". UserError as
/// above.
std::vector<std::string> query_columns(SQLite::Database& database, const std::string& sql);

/// Returns a small table as one text.
std::string query_table(SQLite::Database& database, const std::string& sql, TableStyle style);

/// Returns the rows of a query of this program: a list of {column: value}, with texts made valid
/// UTF-8. UserError (bad_input).
Json query_rows(SQLite::Database& database, const std::string& sql);
/// Returns a draw's row in a table of this program; null without one.
Json row_of_draw(SQLite::Database& database, const std::string& table, std::uint64_t draw);

}  // namespace misalign::schema
