#include "schema/result_table.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cassert>

#include "schema/carried_files.hpp"
#include "schema/storage.hpp"
#include "schema/text_table.hpp"

namespace misalign::schema {
namespace {

const std::string kQueryFolder = "schema/queries/";

UserError bad_sql(const std::string& what) {
  return UserError(kExitUsage, "the query was refused (" + what +
                                   "); it must be one SELECT, or one "
                                   "of the names " +
                                   named_query_list());
}

Json cell_json(const SQLite::Column& cell) {
  if (cell.isInteger()) return cell.getInt64();
  if (cell.isFloat()) return cell.getDouble();
  if (cell.isNull()) return nullptr;
  if (cell.isBlob()) return "(" + std::to_string(cell.getBytes()) + " bytes)";
  return cell.getString();
}

// For people: six digits; JSON and CSV have all.
std::string cell_text(const SQLite::Column& cell) {
  if (cell.isNull()) return "";
  if (cell.isFloat()) return shown_number("%.6g", cell.getDouble());
  const Json value = cell_json(cell);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// Columns of one name are one key in JSON: the later ones get numbers, "draw_2".
Row distinct(const Row& names) {
  Row keys;
  for (const std::string& name : names) {
    std::string key = name;
    const auto taken = [&] {
      return std::find(keys.begin(), keys.end(), key) != keys.end() ||
             (key != name && std::find(names.begin(), names.end(), key) != names.end());
    };
    for (int number = 2; taken(); ++number) key = name + "_" + std::to_string(number);
    keys.push_back(key);
  }
  return keys;
}

}  // namespace

std::string query_table(SQLite::Database& database, const std::string& sql, TableStyle style) {
  try {
    // SQLite prepares the first statement only: a second one would be ignored in silence.
    sqlite3_stmt* first = nullptr;
    const char* rest = nullptr;
    const int code = sqlite3_prepare_v2(database.getHandle(), sql.c_str(), -1, &first, &rest);
    const bool empty = first == nullptr;
    sqlite3_finalize(first);
    if (code != SQLITE_OK) throw SQLite::Exception(database.getHandle(), code);
    if (empty) throw bad_sql("it is empty");
    sqlite3_stmt* second = nullptr;
    const int second_code = sqlite3_prepare_v2(database.getHandle(), rest, -1, &second, nullptr);
    const bool more = second != nullptr;
    sqlite3_finalize(second);
    if (more || second_code != SQLITE_OK) throw bad_sql("more follows after the first statement");

    SQLite::Statement statement(database, sql);
    const int columns = statement.getColumnCount();
    if (columns == 0) throw bad_sql("it gives no rows");
    Row names;
    for (int k = 0; k < columns; ++k) names.emplace_back(statement.getColumnName(k));
    const Row keys = distinct(names);
    std::vector<bool> numeric(columns, true);
    std::vector<Row> rows{names};
    nlohmann::ordered_json list = nlohmann::ordered_json::array();  // columns in their order
    while (statement.executeStep()) {
      Row row;
      nlohmann::ordered_json object = nlohmann::ordered_json::object();
      for (int k = 0; k < columns; ++k) {
        const SQLite::Column cell = statement.getColumn(k);
        if (style == TableStyle::json) {
          object[keys[k]] = cell_json(cell);
          continue;
        }
        numeric[k] = numeric[k] && !cell.isText();
        const bool all_digits = style == TableStyle::csv && cell.isFloat();
        row.push_back(all_digits ? Json(cell.getDouble()).dump() : cell_text(cell));
      }
      style == TableStyle::json ? list.push_back(std::move(object))
                                : rows.push_back(std::move(row));
    }
    if (style == TableStyle::json) {
      return list.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    }
    if (style == TableStyle::aligned) return aligned(rows, numeric);
    std::string text;
    for (const Row& row : rows) {
      for (std::size_t k = 0; k < row.size(); ++k) text += (k ? "," : "") + csv_cell(row[k]);
      text += "\n";
    }
    return text;
  } catch (const SQLite::Exception& error) {
    switch (error.getErrorCode()) {
      case SQLITE_BUSY:
      case SQLITE_CORRUPT:
      case SQLITE_FULL:
      case SQLITE_IOERR:
      case SQLITE_NOMEM:
      case SQLITE_NOTADB:
        throw storage_failure(database.getFilename(), error);
      default:
        throw bad_sql(error.what());
    }
  }
}

std::string named_query(const std::string& name) {
  for (const CarriedFile& file : carried_files()) {
    if (file.path == kQueryFolder + name + ".sql") return file.text;
  }
  return "";
}

std::string best_order() {
  const std::string best = named_query("best");
  const std::size_t begin = best.find("ORDER BY "), end = best.find("LIMIT ");
  assert(begin < end && end != std::string::npos);
  return best.substr(begin, end - begin);
}

std::string named_query_list() {
  std::string names;
  for (const std::string& name : named_queries()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

std::vector<std::string> named_queries() {
  std::vector<std::string> names;
  for (const CarriedFile& file : carried_files()) {
    if (file.path.rfind(kQueryFolder, 0) != 0) continue;
    const std::string name = file.path.substr(kQueryFolder.size());
    names.push_back(name.substr(0, name.size() - 4));
  }
  return names;
}

}  // namespace misalign::schema
