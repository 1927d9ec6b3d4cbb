#include "schema/database.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "schema/older_schema.hpp"

namespace misalign::schema {
namespace {

constexpr int kBusyTimeout_ms = 10000;

// The writer's. Its indexes are touched everywhere at once: pages that stay in memory, and are
// copied from the log to the file after many commits instead of after each, make a candidate of a
// large catalogue several times cheaper.
constexpr int kCache_kb = 64 << 10, kCheckpoint_pages = 8000;

UserError not_a_catalogue(const std::string& path) {
  return UserError(kExitBadInput, path +
                                      ": is no catalogue of misalign (another kind of file); "
                                      "name one that `misalign search` wrote");
}

// A file may be damaged, or come from anywhere: nothing may write into its schema behind SQLite's
// back, and damaged pages are noticed when they are read. (trusted_schema cannot be off:
// SQLite 3.40 takes json_valid in a check for unsafe.)
void distrust(SQLite::Database& database) {
  sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  database.exec("PRAGMA cell_size_check = ON");
}

// Throws unless this is a catalogue that this program can read; false if it is an empty database.
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
      throw UserError(kExitOtherCampaign, path + ": has schema version " + std::to_string(version) +
                                              " (this program knows up to " +
                                              std::to_string(kSchemaVersion) +
                                              "); use the program that wrote it, or a newer one");
    }
    return true;
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_NOTADB) throw not_a_catalogue(path);
    throw;
  }
}

// Reading is allowed, and nothing that could touch another file.
int authorize_reading(void*, int action, const char* name, const char*, const char*, const char*) {
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_READ:
    case SQLITE_RECURSIVE:
    case SQLITE_TRANSACTION:
      return SQLITE_OK;
    case SQLITE_FUNCTION:  // two arguments: a null and the function's name
      return SQLITE_OK;
    case SQLITE_PRAGMA:
      return name && (std::strcmp(name, "table_info") == 0 ||
                      std::strcmp(name, "table_list") == 0 ||
                      std::strcmp(name, "user_version") == 0 ||
                      std::strcmp(name, "foreign_key_check") == 0 ||
                      std::strcmp(name, "integrity_check") == 0)
                 ? SQLITE_OK
                 : SQLITE_DENY;
    default:
      return SQLITE_DENY;
  }
}

}  // namespace

int version_of(SQLite::Database& database) {
  return reading(database, [&] { return database.execAndGet("PRAGMA user_version").getInt(); });
}

UserError damaged(const SQLite::Database& database, const std::string& why) {
  return UserError(kExitBadInput, database.getFilename() + ": is damaged (" + printable(utf8(why)) +
                                      "); put a backup in its place, or see what "
                                      "`misalign verify` says");
}

std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path) {
  std::error_code ignored;  // what may not be looked at is not there
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw UserError(
        kExitBadInput,
        path + ": there is no such file; name a catalogue that `misalign search` wrote");
  }
  try {
    auto database =
        std::make_unique<SQLite::Database>(path, SQLite::OPEN_READONLY, kBusyTimeout_ms);
    distrust(*database);
    if (!check_kind(*database, path)) throw not_a_catalogue(path);
    show_as_of_today(*database, database->execAndGet("PRAGMA user_version").getInt());
    sqlite3_set_authorizer(database->getHandle(), authorize_reading, nullptr);
    return database;
  } catch (const SQLite::Exception& error) {
    throw storage_failure(path, error);
  }
}

std::unique_ptr<SQLite::Database> open_for_writing(const std::string& path, Storage storage) {
  return guarded(path, [&] {
    auto database = std::make_unique<SQLite::Database>(
        path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kBusyTimeout_ms);
    distrust(*database);
    // Before the first look at the file: a log that was left behind needs no shared memory then.
    if (storage == Storage::network) database->exec("PRAGMA locking_mode = EXCLUSIVE");
    check_kind(*database, path);
    database->exec("PRAGMA synchronous = FULL");
    database->exec("PRAGMA foreign_keys = ON");
    database->exec("PRAGMA cache_size = -" + std::to_string(kCache_kb));
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

WriterLock::WriterLock(const std::string& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_CLOEXEC)) {
  if (descriptor_ < 0 && errno == ENOENT) {
    descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    made_the_file_ = descriptor_ >= 0;
  }
  if (descriptor_ < 0) {
    throw UserError(kExitFailure, path + ": cannot be written (" + std::strerror(errno) +
                                      "); choose a writable place with --catalogue");
  }
  struct flock byte {};
  byte.l_type = F_WRLCK;
  byte.l_whence = SEEK_SET;
  byte.l_start = 1LL << 62;
  byte.l_len = 1;
  if (::fcntl(descriptor_, F_OFD_SETLK, &byte) != 0) {
    const int error = errno;
    ::close(descriptor_);
    if (error == EAGAIN || error == EACCES) {
      throw UserError(kExitInUse, path +
                                      ": another search is writing this catalogue; wait for it, or "
                                      "give this one a file of its own with --catalogue");
    }
    throw UserError(kExitFailure, path + ": cannot be locked (" + std::strerror(error) +
                                      "); choose a place whose file system has locks");
  }
}

WriterLock::~WriterLock() { ::close(descriptor_); }

void WriterLock::check_file_is_there() const {
  struct stat opened {
  }, named{};
  if (::fstat(descriptor_, &opened) == 0 && ::stat(path_.c_str(), &named) == 0 &&
      opened.st_dev == named.st_dev && opened.st_ino == named.st_ino) {
    return;
  }
  throw UserError(kExitFailure, path_ +
                                    ": was removed or replaced while this campaign was writing it; "
                                    "put it back (its last copy holds what was committed until "
                                    "then), and the same command goes on from there");
}

}  // namespace misalign::schema
