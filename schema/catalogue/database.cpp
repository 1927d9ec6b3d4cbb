#include "schema/catalogue/database.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <filesystem>

#include "schema/catalogue/catalogue_layout.hpp"
#include "schema/catalogue/connection.hpp"
#include "schema/catalogue/older_schema.hpp"
#include "schema/catalogue/write_ahead_log.hpp"
#include "schema/files/file_name.hpp"

namespace misalign::schema {
namespace {

// Pages of the writer's log before a checkpoint. Pages that stay in memory, and are copied to the
// file after many commits instead of each, make a candidate of a large catalogue several times
// cheaper.
constexpr int kCheckpoint_pages = 8000;

UserError not_a_catalogue(const std::string& path) {
  return UserError(Cause::bad_input, path +
                                         ": is no catalogue of misalign (another kind of file); "
                                         "name one that `misalign search` wrote");
}

UserError unknown_version(const std::string& path, int version, const std::string& way_out) {
  return UserError(Cause::foreign,
                   fmt::format("{}: has schema version {} (this program knows {} to {}); {}", path,
                               version, kOldestSchemaVersion, kSchemaVersion, way_out));
}

UserError without_log(const std::string& path) {
  return UserError(Cause::bad_input,
                   path + ": its log, " + path +
                       "-wal, is missing (this file was copied while a search was writing it, and "
                       "most of it was in the log); copy both while nobody writes, or make the "
                       "copy with misalign merge COPY.db " +
                       path);
}

// Throws unless this is a catalogue that this program can read, laid out as one; then it is
// trusted. Returns false for an empty database.
bool check_kind(SQLite::Database& database, const std::string& path) {
  try {
    const int id = database.execAndGet("PRAGMA application_id").getInt();
    const int version = database.execAndGet("PRAGMA user_version").getInt();
    const int tables = database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt();
    if (id == 0 && version == 0 && tables == 0) return false;
    const int campaigns =
        database.execAndGet("SELECT count(*) FROM sqlite_schema WHERE name = 'campaign'").getInt();
    if (id != kApplicationId || campaigns == 0 || version < 1) throw not_a_catalogue(path);
    if (version > kSchemaVersion) {
      throw unknown_version(path, version, "use the program that wrote it, or a newer one");
    }
    if (version < kOldestSchemaVersion) {
      throw unknown_version(
          path, version, "bring it up to date with misalign 1.0.0: misalign merge NEW.db " + path);
    }
    check_layout(database, version, path);
    trust_schema(database);
    return true;
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_NOTADB) throw not_a_catalogue(path);
    throw;
  }
}

}  // namespace

int version_of(SQLite::Database& database) {
  return reading(database, [&] { return database.execAndGet("PRAGMA user_version").getInt(); });
}

UserError damaged(const SQLite::Database& database, const std::string& why) {
  return UserError(Cause::bad_input,
                   database.getFilename() + ": is damaged (" + printable(utf8(why)) +
                       "); put a backup in its place, or see what `misalign verify` says");
}

std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path) {
  constexpr const char* kSuggestion = "name a catalogue that `misalign search` wrote";
  check_is_file(path, kSuggestion);
  std::error_code ignored;  // a file that may not be read counts as missing
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw UserError(Cause::bad_input, path + ": there is no such file; check the path");
  }
  try {
    auto database = connect(path, Access::read);
    if (!check_kind(*database, path)) {
      throw lacks_log(path) ? without_log(path) : not_a_catalogue(path);
    }
    as_our_own(*database, [&] {
      show_as_of_today(*database, database->execAndGet("PRAGMA user_version").getInt());
    });
    return database;
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_CORRUPT && lacks_log(path)) throw without_log(path);
    throw storage_failure(path, error);
  }
}

std::unique_ptr<SQLite::Database> open_for_writing(const std::string& path, Storage storage,
                                                   int cache_kb) {
  return guarded(path, [&] {
    auto database = connect(path, Access::write);
    // This precedes the first access to the file: a leftover log then needs no shared memory.
    if (storage == Storage::network) database->exec("PRAGMA locking_mode = EXCLUSIVE");
    check_kind(*database, path);
    database->exec("PRAGMA synchronous = FULL");
    database->exec("PRAGMA foreign_keys = ON");
    database->exec("PRAGMA cache_size = -" + std::to_string(cache_kb));
    database->exec("PRAGMA wal_autocheckpoint = " + std::to_string(kCheckpoint_pages));
    return database;
  });
}

SQLite::Statement prepared(SQLite::Database& from, const std::string& sql) {
  return reading(from, [&] { return SQLite::Statement(from, sql); });
}

void copy_rows(SQLite::Database& from, SQLite::Statement& select, SQLite::Statement& insert,
               const std::function<void()>& bind_row) {
  while (reading(from, [&] { return select.executeStep(); })) {
    insert.tryReset();
    bind_row();
    try {
      insert.exec();
    } catch (const SQLite::Exception& error) {
      if (error.getErrorCode() != SQLITE_CONSTRAINT) throw;
      throw damaged(from, error.what());
    }
  }
}

void bind_value(SQLite::Statement& statement, int index, const SQLite::Column& value) {
  switch (value.getType()) {
    case SQLITE_INTEGER:
      return statement.bind(index, value.getInt64());
    case SQLITE_FLOAT:
      return statement.bind(index, value.getDouble());
    case SQLITE_TEXT:
      return statement.bind(index, value.getString());
    case SQLITE_BLOB:
      return statement.bind(index, value.getBlob(), value.getBytes());
    default:
      return statement.bind(index);
  }
}

}  // namespace misalign::schema
