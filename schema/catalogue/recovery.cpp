#include "schema/catalogue/recovery.hpp"

#include <chrono>
#include <thread>
#include <utility>

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
    // Its first access to the file recovers it.
    auto database = open_for_writing(file, file_system_of(file).storage);
    if (is_without_log) {
      if (version_of(*database) != kSchemaVersion) return;  // checked once a search has migrated it
      expect_sound_without_log(*database, file);
    }
    close_as_one_file(std::move(database), file);
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
