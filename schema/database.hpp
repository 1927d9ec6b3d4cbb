// Opening SQLite files with sentences for what can go wrong, and reading without any risk of
// writing.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <memory>
#include <string>

#include "schema/storage.hpp"

namespace misalign::schema {

inline constexpr int kApplicationId = 0x4D53414C;
inline constexpr int kSchemaVersion = 4;

/// Draws and counts as SQLite keeps them: below 2^63, so that the sign is never used.
inline std::int64_t stored(std::uint64_t draw) { return static_cast<std::int64_t>(draw); }
inline std::uint64_t draw_of(const SQLite::Column& column) {
  return static_cast<std::uint64_t>(column.getInt64());
}

/// A text as it is stored, made UTF-8.
inline std::string text_of(const SQLite::Column& column) { return utf8(column.getString()); }

/// The schema that a catalogue was written with, or brought up to.
int version_of(SQLite::Database& database);

/// A damaged file, or one that another program changed: exit code 3.
UserError damaged(const SQLite::Database& database, const std::string& why);

/// Calls `work`, which reads; what SQLite throws becomes a UserError about the database's file.
template <class Work>
auto reading(const SQLite::Database& database, const Work& work) {
  return guarded(database.getFilename(), work);
}

/// A catalogue opened for reading: it cannot write, attach other files or load extensions.
/// UserError: 3 no such file or no catalogue, 5 a newer schema; see storage_failure.
std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path);

/// The one writer's connection: synchronous FULL, foreign keys, on network storage alone with the
/// file until it is closed. Changes nothing in the file yet. Creates the file if there is none.
/// UserError: 3 no catalogue, 5 a newer schema; see storage_failure.
std::unique_ptr<SQLite::Database> open_for_writing(const std::string& path, Storage storage);

/// A statement that reads; UserError as from reading().
SQLite::Statement prepared(SQLite::Database& from, const std::string& sql);

/// Binds whatever a column of another statement holds.
void bind_value(SQLite::Statement& statement, int index, const SQLite::Column& value);

/// Runs `insert` for every row of `select`, once `bind_row` has bound it. UserError (3) about
/// `from` if it cannot be read, or holds rows that checks and keys of the target forbid.
void copy_rows(SQLite::Database& from, SQLite::Statement& select, SQLite::Statement& insert,
               const std::function<void()>& bind_row);

/// An exclusive advisory lock on the catalogue's file that dies with the process: an open-file lock
/// of one byte far behind those that SQLite locks.
class WriterLock {
 public:
  /// Creates an empty file if there is none. UserError: 1 cannot be opened, 4 held by another
  /// process.
  explicit WriterLock(const std::string& path);
  /// Closing any descriptor of the file drops SQLite's own locks in this process: so this object
  /// must outlive the connection.
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

  /// Whether there was no file before.
  bool made_the_file() const { return made_the_file_; }
  /// UserError (1) if the path leads to another file now, or to none: SQLite would go on writing to
  /// a file that nobody can find.
  void check_file_is_there() const;

 private:
  const std::string path_;
  bool made_the_file_ = false;
  int descriptor_;
};

}  // namespace misalign::schema
