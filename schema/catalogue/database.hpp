// Opens SQLite files, with a clear error for each failure. Opening for reading never writes.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "schema/files/storage.hpp"

namespace misalign::schema {

inline constexpr int kApplicationId = 0x4D53414C;
inline constexpr int kSchemaVersion = 11;
inline constexpr int kOldestSchemaVersion = 7;  ///< oldest that is read; release 1.0.0 wrote it

/// Returns a draw or count as SQLite stores it: below 2^63, so that the sign is unused.
inline std::int64_t stored(std::uint64_t draw) { return static_cast<std::int64_t>(draw); }
inline std::uint64_t draw_of(const SQLite::Column& column) {
  return static_cast<std::uint64_t>(column.getInt64());
}

/// Returns a stored text, made valid UTF-8.
inline std::string text_of(const SQLite::Column& column) { return utf8(column.getString()); }

/// Returns the schema version of a catalogue.
int version_of(SQLite::Database& database);

/// Returns the error of a file that is damaged or that another program changed: a bad input.
UserError damaged(const SQLite::Database& database, const std::string& why);

/// Calls `work`, which reads; exceptions of SQLite become errors about the database's file.
template <class Work>
auto reading(const SQLite::Database& database, const Work& work) {
  return guarded(database.getFilename(), work);
}

/// Opens a catalogue for reading: it cannot write or touch other files, see connect(). UserError:
/// bad_input without such a file, if it is no catalogue, or is not laid out as one (check_layout);
/// foreign if its schema is newer, or older than that of release 1.0.0; see storage_failure.
std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path);

/// Page caches. Indexes of candidates are accessed everywhere at once; pieces of populations are
/// accessed once, and particles need the memory.
inline constexpr int kCache_kb = 64 << 10, kSplittingCache_kb = 8 << 10;

/// Opens the only writer's connection: synchronous FULL, foreign keys, exclusive on network storage
/// until it is closed. Changes nothing in the file yet; creates it if there is none. UserError:
/// bad_input if it is no catalogue, or not laid out as one; foreign if its schema is newer or too
/// old; see storage_failure.
std::unique_ptr<SQLite::Database> open_for_writing(const std::string& path, Storage storage,
                                                   int cache_kb = kCache_kb);

/// Prepares a statement that reads; UserError as from reading().
SQLite::Statement prepared(SQLite::Database& from, const std::string& sql);

/// Bytes, as opposed to text.
struct Blob {
  template <class Bytes>
  explicit Blob(const Bytes& bytes) : data(bytes.data()), size(bytes.size()) {}
  const void* data;
  std::size_t size;
};

/// Binds a number, a text, a draw as it is stored, null for no value, or the value of another
/// statement's column.
template <class Value>
void bind_value(SQLite::Statement& statement, int index, const Value& value) {
  statement.bind(index, value);
}
void bind_value(SQLite::Statement& statement, int index, const SQLite::Column& value);
inline void bind_value(SQLite::Statement& statement, int index, const Blob& value) {
  statement.bind(index, value.data, static_cast<int>(value.size));
}
inline void bind_value(SQLite::Statement& statement, int index, std::uint64_t value) {
  statement.bind(index, stored(value));
}
template <class Value>
void bind_value(SQLite::Statement& statement, int index, const std::optional<Value>& value) {
  value ? bind_value(statement, index, *value) : statement.bind(index);
}

/// Resets a statement and binds these values to its parameters, in turn.
template <class... Values>
void bind_all(SQLite::Statement& statement, const Values&... values) {
  statement.tryReset();
  int index = 0;
  (bind_value(statement, ++index, values), ...);
}

/// Runs a statement without result rows with these values; returns the number of changed rows.
template <class... Values>
int execute(SQLite::Statement& statement, const Values&... values) {
  bind_all(statement, values...);
  const int changed = statement.exec();
  statement.reset();
  return changed;
}

/// Prepares a statement and binds these values.
template <class... Values>
SQLite::Statement bound(SQLite::Database& database, const std::string& sql,
                        const Values&... values) {
  SQLite::Statement statement(database, sql);
  bind_all(statement, values...);
  return statement;
}

/// Runs `insert` for every row of `select`, after `bind_row` has bound it. UserError (bad_input)
/// about `from` if it cannot be read, or holds rows that checks and keys of the target forbid.
void copy_rows(SQLite::Database& from, SQLite::Statement& select, SQLite::Statement& insert,
               const std::function<void()>& bind_row);

}  // namespace misalign::schema
