#include "schema/catalogue/file_check.hpp"

#include <sqlite3.h>

#include <cstdlib>
#include <string>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/sql_tokens.hpp"

namespace misalign::schema {
namespace {

// Returns the conditions of a table's CHECKs, each within its brackets.
std::vector<std::string> conditions_of(const std::string& table_sql) {
  const SqlTokens sql = sql_tokens(table_sql);
  std::vector<std::string> conditions;
  for (std::size_t check = 0; check + 1 < sql.tokens.size(); ++check) {
    if (sql.tokens[check] != "CHECK") continue;
    std::size_t last = check + 1;
    for (int open = 1; open > 0 && last + 1 < sql.tokens.size();) {
      ++last;
      open += (sql.tokens[last] == "(") - (sql.tokens[last] == ")");
    }
    const std::size_t from = sql.begins[check + 1];
    conditions.push_back(table_sql.substr(from, sql.begins[last] + 1 - from));
  }
  return conditions;
}

// Checks the CHECKs, which SQLite skips when it reads a file, and which its integrity_check skips.
void check_constraints(SQLite::Database& database, std::vector<Finding>& findings) {
  SQLite::Statement table(database,
                          "SELECT name, sql FROM main.sqlite_schema WHERE type = 'table'");
  while (table.executeStep()) {
    const std::string name = text_of(table.getColumn(0));
    const auto conditions = conditions_of(text_of(table.getColumn(1)));
    if (conditions.empty() || name == "piece" || name.find('"') != std::string::npos) continue;
    std::string broken;  // a null condition holds
    for (const std::string& condition : conditions) {
      broken += (broken.empty() ? "" : ", ") + ("total(NOT " + condition + ")");
    }
    SQLite::Statement rows(database, "SELECT " + broken + " FROM main.\"" + name + "\"");
    rows.executeStep();
    for (std::size_t k = 0; k < conditions.size(); ++k) {
      const std::int64_t count = rows.getColumn(static_cast<int>(k)).getInt64();
      if (count == 0) continue;
      findings.push_back(differs("table " + name, "rows that break " + conditions[k], count, 0));
    }
  }
}

// Throws if the disk failed: integrity_check lists unreadable pages among the damaged ones, with
// SQLite's code.
void throw_if_unread(const SQLite::Database& database, const std::string& answer) {
  static const std::string kCode = "error code=";
  const std::size_t at = answer.find(kCode);
  if (at == std::string::npos) return;
  const int code = std::atoi(answer.c_str() + at + kCode.size()) & 0xff;
  if (code != SQLITE_IOERR && code != SQLITE_NOMEM) return;
  throw storage_failure(database.getFilename(), SQLite::Exception(answer, code));
}

}  // namespace

std::vector<Finding> check_file(SQLite::Database& database) {
  std::vector<Finding> findings;
  check_constraints(database, findings);
  SQLite::Statement integrity(database, "PRAGMA integrity_check");
  while (integrity.executeStep()) {
    const std::string answer = text_of(integrity.getColumn(0));
    throw_if_unread(database, answer);
    if (answer != "ok") findings.push_back(differs("file", "integrity_check", answer, "ok"));
  }
  SQLite::Statement keys(database, "PRAGMA foreign_key_check");
  while (keys.executeStep()) {
    findings.push_back(
        differs("table " + text_of(keys.getColumn(0)) + ", row " + text_of(keys.getColumn(1)),
                "key into " + text_of(keys.getColumn(2)), "no such row", "a row"));
  }
  return findings;
}

}  // namespace misalign::schema
