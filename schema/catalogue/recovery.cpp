#include "schema/catalogue/recovery.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/writer_lock.hpp"
#include "schema/files/file_bytes.hpp"
#include "schema/files/file_name.hpp"

namespace misalign::schema {
namespace {

std::uintmax_t size_of(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  return error ? 0 : bytes;
}

}  // namespace

void recover(const std::string& path) {
  const std::string file = end_of_links(path);
  const WriterLock lock(file, Missing::refused);
  guarded(file, [&] {
    const Storage storage = file_system_of(file).storage;
    const auto database = open_for_writing(file, storage);  // its first look at the file does it
    database->tryExec("PRAGMA journal_mode = DELETE");
  });
}

void recover_before_writing(const std::string& path) {
  constexpr int kMostTries = 100;
  const std::string journal = end_of_links(path) + "-journal";
  for (int tries = 0; size_of(journal) > 0 && tries < kMostTries; ++tries) {
    try {
      return recover(path);
    } catch (const UserError& error) {
      if (error.cause() != Cause::in_use) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
}

// SQLite's header: bytes 18 and 19 are the versions of the format that writing and reading need,
// and 2 where there is a log.
bool lacks_log(const std::string& path) {
  constexpr std::size_t kWriteVersion = 18;
  constexpr char kWithLog = 2;
  const std::string file = end_of_links(path);
  char header[kWriteVersion + 1] = {};
  std::ifstream in(file, std::ios::binary);
  if (!in.read(header, sizeof header)) return false;
  return std::string_view(header, kDatabaseHeader.size()) == kDatabaseHeader &&
         header[kWriteVersion] == kWithLog && size_of(file + "-wal") == 0 &&
         !is_being_written(file);
}

}  // namespace misalign::schema
