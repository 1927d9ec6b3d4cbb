#include "schema/catalogue/write_ahead_log.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <filesystem>

namespace misalign::schema {
namespace {

// A log that readers keep from being emptied is emptied by waiting for them, from this size on;
// usually it is written from its start again at 32 MB (see open_for_writing).
constexpr std::uintmax_t kLargestLog_bytes = 44 << 20;
constexpr int kWaitForReaders_ms = 300, kWaitForWriters_ms = 10000;

int checkpoint(SQLite::Database& database) {
  database.setBusyTimeout(kWaitForReaders_ms);
  const int result = database.tryExec("PRAGMA wal_checkpoint(TRUNCATE)");
  database.setBusyTimeout(kWaitForWriters_ms);
  return result;
}

}  // namespace

// Before new work: what a full disk kept in the log takes twice its room for as long as it is
// there, and every start would add to it. Readers may keep it, which does no harm.
void WriteAheadLog::fold_in() {
  if (storage_ == Storage::network) return;
  const int result = checkpoint(database_);
  if (result != SQLITE_OK && result != SQLITE_BUSY && result != SQLITE_LOCKED) {
    throw SQLite::Exception(database_.getHandle(), result);
  }
}

// Where that fails, as on a full disk, the log keeps it all, and the next commit says why.
void WriteAheadLog::copy_into_file() {
  if (storage_ == Storage::local) database_.tryExec("PRAGMA wal_checkpoint(PASSIVE)");
}

// The log is written from its start again once no reader needs it, but with readers all the time
// that moment never comes by itself.
void WriteAheadLog::keep_small() {
  std::error_code error;
  const auto log_bytes = [&] {
    const auto bytes = std::filesystem::file_size(path_ + "-wal", error);
    return error ? 0 : bytes;
  };
  // A reader that stays at one moment keeps it: not every commit is to wait for that one again.
  if (log_bytes() <= std::max(kLargestLog_bytes, kept_bytes_ + kLargestLog_bytes / 4)) return;
  checkpoint(database_);
  kept_bytes_ = log_bytes();
}

}  // namespace misalign::schema
