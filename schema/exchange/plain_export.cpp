#include "schema/exchange/plain_export.hpp"

#include <sqlite3.h>

#include <string_view>

#include "schema/catalogue/connection.hpp"
#include "schema/catalogue/database.hpp"
#include "schema/catalogue/since.hpp"
#include "schema/files/output_file.hpp"

namespace misalign::schema {
namespace {

// Tables and views alike, as the file itself has them; what is an INTEGER PRIMARY KEY stays one.
constexpr const char* kTables[] = {"campaign",  "run",       "unit",         "screened",
                                   "undecided", "candidate", "fault_sample", "displacements",
                                   "diagonals", "yield",     "certificate",  "common_yield",
                                   "ascent"};

// Those that old readers understand.
constexpr const char* kViews = "'candidates', 'acceptance', 'faults', 'yields'";

// The version of the schema since which there is a table.
int since(std::string_view table) {
  if (table == "ascent") return kAscentSince;
  return table.ends_with("yield") ? kYieldSince : table == "certificate" ? kCertificateSince : 1;
}

// The column that is the rows' number, if there is one: no part of a key of several.
std::string integer_key(SQLite::Database& database, const std::string& table) {
  return reading(database, [&] {
    SQLite::Statement columns(database, "PRAGMA main.table_info(" + table + ")");
    std::string key;
    int parts = 0;
    while (columns.executeStep()) {
      if (columns.getColumn("pk").getInt() == 0) continue;
      ++parts;
      const bool is_integer = columns.getColumn("type").getString() == "INTEGER";
      key = is_integer ? columns.getColumn("name").getString() : "";
    }
    return parts == 1 ? key : "";
  });
}

void copy_table(SQLite::Database& from, SQLite::Database& into, const std::string& name) {
  SQLite::Statement rows = prepared(from, "SELECT * FROM main." + name);
  const int columns = rows.getColumnCount();
  std::string declared, places;
  const std::string key = integer_key(from, name);
  for (int k = 0; k < columns; ++k) {
    const std::string column = rows.getColumnName(k);
    declared +=
        (k > 0 ? ", \"" : "\"") + column + "\"" + (column == key ? " INTEGER PRIMARY KEY" : "");
    places += k > 0 ? ", ?" : "?";
  }
  into.exec("CREATE TABLE " + name + " (" + declared + ")");
  SQLite::Statement insert(into, "INSERT INTO " + name + " VALUES (" + places + ")");
  copy_rows(from, rows, insert, [&] {
    for (int k = 0; k < columns; ++k) bind_value(insert, k + 1, rows.getColumn(k));
  });
}

}  // namespace

void export_plain(SQLite::Database& catalogue, const std::string& output) {
  OutputFile file = OutputFile::database(output, {catalogue.getFilename()});
  const auto write = [&] {
    SQLite::Transaction snapshot(catalogue);
    const auto opened = connect(file.path(), Access::write);
    SQLite::Database& plain = *opened;
    SQLite::Transaction transaction(plain);
    const int version = version_of(catalogue);
    for (const char* table : kTables) {
      if (version >= since(table)) copy_table(catalogue, plain, table);
    }
    plain.exec(
        "CREATE INDEX displacements_of ON displacements (draw);"
        "CREATE INDEX diagonals_of ON diagonals (draw);");
    SQLite::Statement views(
        catalogue, std::string("SELECT sql FROM sqlite_schema WHERE type = 'view' AND name IN (") +
                       kViews + ")");
    while (views.executeStep()) plain.exec(views.getColumn(0).getString());
    transaction.commit();
  };
  guarded(file.path(), [&] {
    try {
      write();
    } catch (const SQLite::Exception& error) {
      if (error.getErrorCode() != SQLITE_ERROR) throw;
      throw damaged(catalogue, error.what());  // columns that no catalogue has
    }
  });
  file.publish();
}

}  // namespace misalign::schema
