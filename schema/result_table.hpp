// The rows of a query for people (aligned), for programs (JSON) and for spreadsheets (CSV).
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <vector>

namespace misalign::schema {

enum class TableStyle { aligned, json, csv };

/// The first line of an aligned table, and of CSV, names the columns.
/// Runs one read-only statement to its end. UserError (2) if it is no SQL, not a single statement,
/// or more than a query; see storage_failure for what can happen to the file.
std::string query_table(SQLite::Database& database, const std::string& sql, TableStyle style);

/// The SQL of a named query; empty if there is no such name.
std::string named_query(const std::string& name);
/// What "the best first" means, stated in the query `best`: "ORDER BY ..., ..." on the columns of
/// the view candidates.
std::string best_order();
/// "acceptance, best, ..."
std::string named_query_list();
std::vector<std::string> named_queries();

}  // namespace misalign::schema
