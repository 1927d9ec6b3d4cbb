#include "schema/catalogue/write_ahead_log.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "schema/catalogue/journal_check.hpp"
#include "schema/catalogue/writer_lock.hpp"
#include "schema/files/file_bytes.hpp"
#include "schema/files/file_name.hpp"

namespace misalign::schema {
namespace {

// The log size from which a commit waits for readers that keep it from being emptied; usually it is
// overwritten from its start at 32 MB (see open_for_writing).
constexpr std::uintmax_t kLargestLog_bytes = 44 << 20;
constexpr int kWaitForReaders_ms = 300, kWaitForWriters_ms = 10000;

int checkpoint(SQLite::Database& database) {
  database.setBusyTimeout(kWaitForReaders_ms);
  const int result = database.tryExec("PRAGMA wal_checkpoint(TRUNCATE)");
  database.setBusyTimeout(kWaitForWriters_ms);
  return result;
}

}  // namespace

// Called before new work: a log that a full disk has kept would take its space twice, and grow with
// every start. Readers may keep it, which does no harm.
void WriteAheadLog::fold_in() {
  if (storage_ == Storage::network) return;
  const int result = checkpoint(database_);
  if (result != SQLITE_OK && result != SQLITE_BUSY && result != SQLITE_LOCKED) {
    throw SQLite::Exception(database_.getHandle(), result);
  }
}

// A failure, as on a full disk, leaves the log as it is, and the next commit reports it.
void WriteAheadLog::copy_into_file() {
  if (storage_ == Storage::local) database_.tryExec("PRAGMA wal_checkpoint(PASSIVE)");
}

// SQLite overwrites the log from its start once no reader needs it. With readers all the time that
// moment never comes by itself.
void WriteAheadLog::keep_small() {
  const auto log_bytes = [&] { return journal_bytes(path_ + "-wal"); };
  // A reader that keeps an old snapshot keeps the log: not every commit may wait for it again.
  if (log_bytes() <= std::max(kLargestLog_bytes, kept_bytes_ + kLargestLog_bytes / 4)) return;
  checkpoint(database_);
  kept_bytes_ = log_bytes();
}

void write_leftovers_again(const std::string& path, bool lacks_log) {
  check_journals(path);
  const std::string leftover = lacks_log ? path : path + "-wal";
  if (journal_bytes(leftover) == 0) return;
  const int descriptor = ::open(leftover.c_str(), O_RDWR | O_CLOEXEC);
  std::vector<char> part(std::size_t{1} << 20);
  ssize_t size = descriptor < 0 ? -1 : 1;
  for (off_t at = 0; size > 0; at += size) {
    size = uninterrupted([&] { return ::pread(descriptor, part.data(), part.size(), at); });
    if (size <= 0) break;
    const auto bytes = static_cast<std::size_t>(size);
    size = uninterrupted([&] { return ::pwrite(descriptor, part.data(), bytes, at); });
  }
  const bool is_written = size == 0 && uninterrupted([&] { return ::fsync(descriptor); }) == 0;
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (is_written) return;
  throw UserError(Cause::failure, leftover + ": cannot be written again (" + std::strerror(error) +
                                      "); see to its permissions and the disk, then the same "
                                      "command goes on");
}

void close_as_one_file(std::unique_ptr<SQLite::Database> database, const std::string& path) {
  database->setBusyTimeout(0);
  const int result = database->tryExec("PRAGMA journal_mode = DELETE");
  database.reset();
  // SQLite does not sync that it has removed a journal: a power cut would bring it back.
  sync_directory_of(path);
  if (result == SQLITE_OK || result == SQLITE_BUSY || result == SQLITE_LOCKED) return;
  throw storage_failure(path, SQLite::Exception(sqlite3_errstr(result), result));
}

std::uintmax_t journal_bytes(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  return error ? 0 : bytes;
}

// Bytes 18 and 19 of SQLite's header are the versions of the format that writing and reading need,
// 2 if there is a log.
bool lacks_log(const std::string& path) {
  constexpr std::size_t kWriteVersion = 18;
  constexpr char kWithLog = 2;
  const std::string file = end_of_links(path);
  char header[kWriteVersion + 1] = {};
  const int descriptor =
      ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // or a pipe waits
  if (descriptor < 0) return false;
  const ssize_t size = uninterrupted([&] { return ::read(descriptor, header, sizeof header); });
  ::close(descriptor);
  if (size != static_cast<ssize_t>(sizeof header)) return false;
  return std::string_view(header, kDatabaseHeader.size()) == kDatabaseHeader &&
         header[kWriteVersion] == kWithLog && journal_bytes(file + "-wal") == 0 &&
         !is_being_written(file);
}

}  // namespace misalign::schema
