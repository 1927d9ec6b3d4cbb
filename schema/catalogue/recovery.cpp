#include "schema/catalogue/recovery.hpp"

#include <chrono>
#include <thread>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/write_ahead_log.hpp"
#include "schema/catalogue/writer_lock.hpp"
#include "schema/files/file_name.hpp"

namespace misalign::schema {

void recover(const std::string& path) {
  const std::string file = end_of_links(path);
  const WriterLock lock(file, Missing::refused);
  guarded(file, [&] {
    const Storage storage = file_system_of(file).storage;
    const auto database =
        open_for_writing(file, storage);  // its first access to the file recovers it
    database->tryExec("PRAGMA journal_mode = DELETE");
  });
}

void recover_before_writing(const std::string& path) {
  constexpr int kMostTries = 100;
  const std::string journal = end_of_links(path) + "-journal";
  for (int tries = 0; journal_bytes(journal) > 0 && tries < kMostTries; ++tries) {
    try {
      return recover(path);
    } catch (const UserError& error) {
      if (error.cause() != Cause::in_use) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
}

}  // namespace misalign::schema
