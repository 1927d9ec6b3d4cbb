#include "schema/catalogue/recovery.hpp"

#include <chrono>
#include <thread>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/database.hpp"
#include "schema/catalogue/ledger_check.hpp"
#include "schema/catalogue/write_ahead_log.hpp"
#include "schema/catalogue/writer_lock.hpp"
#include "schema/files/file_name.hpp"

namespace misalign::schema {

void expect_sound_without_log(SQLite::Database& database, const std::string& path) {
  const auto findings = check_ledger(database, read_campaign_of(database, path));
  if (findings.empty()) return;
  throw UserError(Cause::bad_input, path + ": its log, " + path +
                                        "-wal, is missing, and the file contradicts itself " +
                                        "without it (" +
                                        printable(utf8(findings.front().sentence)) +
                                        "); put the log back, or a backup in place of both");
}

void recover(const std::string& path) {
  const std::string file = end_of_links(path);
  const bool is_without_log = lacks_log(file);
  const WriterLock lock(file, Missing::refused);
  guarded(file, [&] {
    write_leftovers_again(file, is_without_log);
    const Storage storage = file_system_of(file).storage;
    const auto database =
        open_for_writing(file, storage);  // its first access to the file recovers it
    const bool is_of_today = version_of(*database) == kSchemaVersion;
    if (is_without_log && !is_of_today) return;  // the next search migrates it, and checks it then
    if (is_without_log) expect_sound_without_log(*database, file);
    database->tryExec("PRAGMA journal_mode = DELETE");
  });
  sync_directory_of(file);
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
