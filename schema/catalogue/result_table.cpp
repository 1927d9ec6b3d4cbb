#include "schema/catalogue/result_table.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <utility>

#include "schema/catalogue/candidate_words.hpp"
#include "schema/catalogue/database.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "schema/files/storage.hpp"
#include "schema/files/text_table.hpp"

namespace misalign::schema {
namespace {

UserError bad_sql(const std::string& what) {
  return UserError(Cause::bad_request, "the query was refused (" + what +
                                           "); it must be one SELECT, or one "
                                           "of the names " +
                                           named_query_list());
}

// Returns a suggestion for a name that SQLite does not know.
std::string meant_by(SQLite::Database& database, const std::string& refused) {
  const UnknownWord word = unknown_word_of(refused);
  return word.kind ? column_meant(word.typed, columns_of_candidates(database)) : "";
}

Json cell_json(const SQLite::Column& cell) {
  if (cell.isInteger()) return cell.getInt64();
  if (cell.isFloat()) return cell.getDouble();
  if (cell.isNull()) return nullptr;
  if (cell.isBlob()) return "(" + std::to_string(cell.getBytes()) + " bytes)";
  return cell.getString();
}

// Returns the present row of a statement by the names of its columns.
Json row_json(SQLite::Statement& row) {
  Json json = Json::object();
  for (int k = 0; k < row.getColumnCount(); ++k) {
    Json cell = cell_json(row.getColumn(k));
    json[utf8(row.getColumnName(k))] =
        cell.is_string() ? Json(utf8(cell.get_ref<const std::string&>())) : std::move(cell);
  }
  return json;
}

// Returns a cell's text for people, with six digits; JSON and CSV have all.
std::string cell_text(const SQLite::Column& cell) {
  if (cell.isNull()) return "";
  if (cell.isFloat()) return fmt::format("{:.6g}", cell.getDouble());
  const Json value = cell_json(cell);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// Makes names distinct, as JSON needs: later equal ones get numbers, "draw_2".
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

// SQLite prepares the first statement only: a second one would be ignored in silence.
void check_single(SQLite::Database& database, const std::string& sql) {
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
}

Row names_of(SQLite::Statement& statement) {
  if (statement.getColumnCount() == 0) throw bad_sql("it gives no rows");
  Row names;
  for (int k = 0; k < statement.getColumnCount(); ++k) {
    names.emplace_back(statement.getColumnName(k));
  }
  return names;
}

/// The rows of a statement, written in one of the styles.
class TableWriter {
 public:
  TableWriter(SQLite::Statement& statement, const TextSink& sink)
      : statement_(statement), sink_(sink), names_(names_of(statement)) {}

  std::uint64_t write(TableStyle style) {
    switch (style) {
      case TableStyle::json:
        write_json();
        break;
      case TableStyle::csv:
        write_csv();
        break;
      case TableStyle::aligned:
        write_aligned();
    }
    return rows_;
  }

 private:
  int columns() const { return statement_.getColumnCount(); }
  // Steps to the next row; false at the end, or if the sink wants no more.
  bool next() {
    if (!wanted_ || !statement_.executeStep()) return false;
    ++rows_;
    return true;
  }
  void give(const std::string& piece) { wanted_ = wanted_ && sink_(piece); }

  void write_json() {
    const Row keys = distinct(names_);
    while (next()) {
      nlohmann::ordered_json object = nlohmann::ordered_json::object();  // columns in their order
      for (int k = 0; k < columns(); ++k) object[keys[k]] = cell_json(statement_.getColumn(k));
      const std::string text =
          object.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
      std::string piece = rows_ == 1 ? "[\n " : ",\n ";
      for (const char c : text) piece += c == '\n' ? "\n " : std::string(1, c);
      give(piece);
    }
    give(rows_ == 0 ? "[]\n" : "\n]\n");
  }

  void write_csv() {
    const auto line = [](const Row& row) {
      std::string text;
      for (std::size_t k = 0; k < row.size(); ++k) text += (k ? "," : "") + csv_cell(row[k]);
      return text + "\n";
    };
    give(line(names_));
    while (next()) {
      Row row;
      for (int k = 0; k < columns(); ++k) {
        const SQLite::Column cell = statement_.getColumn(k);
        row.push_back(cell.isFloat() ? Json(cell.getDouble()).dump() : cell_text(cell));
      }
      give(line(row));
    }
  }

  Row aligned_row() const {
    Row row;
    for (int k = 0; k < columns(); ++k) row.push_back(cell_text(statement_.getColumn(k)));
    return printable_row(std::move(row));
  }

  // Keeps the first rows until they give the columns' widths; writes the others at once. Time is
  // processor time: a table must not depend on other processes.
  void write_aligned() {
    constexpr std::size_t kKept = 1000, kKept_bytes = 4 << 20;
    constexpr std::clock_t kKeptFor = CLOCKS_PER_SEC;
    const std::clock_t begin = std::clock();
    Columns table(std::vector<bool>(names_.size(), true));
    std::vector<Row> kept = {printable_row(names_)};
    table.widen(kept.front());
    std::size_t bytes = 0;
    const auto give_kept = [&] {
      for (const Row& row : kept) give(table.line(row));
      kept.clear();
    };
    while (next()) {
      for (int k = 0; k < columns(); ++k) {
        if (statement_.getColumn(k).isText()) table.set_text(static_cast<std::size_t>(k));
      }
      const bool keeps = !kept.empty();
      kept.push_back(aligned_row());
      table.widen(kept.back());
      for (const std::string& cell : kept.back()) bytes += cell.size() + sizeof(std::string);
      if (!keeps || rows_ == kKept || bytes > kKept_bytes || std::clock() - begin > kKeptFor) {
        give_kept();
      }
    }
    give_kept();
  }

  SQLite::Statement& statement_;
  const TextSink& sink_;
  Row names_;
  std::uint64_t rows_ = 0;
  bool wanted_ = true;
};

// Runs `work` on a single reading statement within a snapshot.
template <class Work>
auto ask(SQLite::Database& database, const std::string& sql, const Work& work) {
  try {
    check_single(database, sql);
    std::optional<SQLite::Transaction> snapshot;  // otherwise the caller's
    if (sqlite3_get_autocommit(database.getHandle())) snapshot.emplace(database);
    SQLite::Statement statement(database, sql);
    return work(statement);
  } catch (const SQLite::Exception& error) {
    switch (error.getErrorCode()) {
      case SQLITE_BUSY:
      case SQLITE_CORRUPT:
      case SQLITE_FULL:
      case SQLITE_IOERR:
      case SQLITE_NOMEM:
      case SQLITE_NOTADB:
        throw storage_failure(database.getFilename(), error);
      case SQLITE_ABORT:  // a function that is missing in this build, with its own message
        throw UserError(Cause::failure, error.what());
      default:
        throw bad_sql(error.what() + meant_by(database, error.what()));
    }
  }
}

}  // namespace

std::uint64_t write_query(SQLite::Database& database, const std::string& sql, TableStyle style,
                          const TextSink& sink) {
  return ask(database, sql, [&](SQLite::Statement& statement) {
    return TableWriter(statement, sink).write(style);
  });
}

void read_query(SQLite::Database& database, const std::string& sql, const RowReader& read) {
  ask(database, sql, [&](SQLite::Statement& row) {
    while (row.executeStep()) read(row);
  });
}

std::vector<std::string> query_columns(SQLite::Database& database, const std::string& sql) {
  return ask(database, sql, [](SQLite::Statement& statement) {
    Row names = distinct(names_of(statement));
    for (std::string& name : names) name = utf8(name);
    return names;
  });
}

Json row_of_draw(SQLite::Database& database, const std::string& table, std::uint64_t draw) {
  return reading(database, [&] {
    SQLite::Statement row = bound(database, "SELECT * FROM " + table + " WHERE draw = ?", draw);
    return row.executeStep() ? row_json(row) : Json();
  });
}

std::string query_table(SQLite::Database& database, const std::string& sql, TableStyle style) {
  std::string text;
  write_query(database, sql, style, [&](const std::string& piece) {
    text += piece;
    return true;
  });
  return text;
}

Json query_rows(SQLite::Database& database, const std::string& sql) {
  return reading(database, [&] {
    SQLite::Statement row(database, sql);
    Json rows = Json::array();
    while (row.executeStep()) rows.push_back(row_json(row));
    return rows;
  });
}

}  // namespace misalign::schema
