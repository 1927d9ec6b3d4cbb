// Keeps SQLite's write-ahead log beside a catalogue small and durable, and notices where it is
// missing.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <memory>
#include <string>

#include "schema/files/storage.hpp"

namespace misalign::schema {

/// The log of a catalogue on a local disk; on network storage there is none, and nothing is done.
class WriteAheadLog {
 public:
  WriteAheadLog(SQLite::Database& database, const std::string& path, Storage storage)
      : database_(database), path_(path), storage_(storage) {}

  /// Folds the log into the file and empties it, unless a reader keeps it. Throws
  /// SQLite::Exception.
  void fold_in();
  /// Copies into the file what no reader needs in the log, which stays.
  void copy_into_file();
  /// Folds the log in after a commit, once it is too large.
  void keep_small();

 private:
  SQLite::Database& database_;
  const std::string path_;
  const Storage storage_;
  std::uintmax_t kept_bytes_ = 0;  // size when it could last not be folded in
};

/// Writes what another program has left once more, byte for byte, and syncs it: the log, or where
/// it `lacks_log` the file itself. If that program's last sync failed, the system counts bytes as
/// written that the disk does not have, and no later sync would write them. Under the writer's
/// lock, and without connections to the file. UserError: failure, or as from check_journals.
void write_leftovers_again(const std::string& path, bool lacks_log);

/// Closes a writer's connection and leaves one plain file, readable even in a read-only directory,
/// also after a power cut. A reader that is active now prevents that, which does no harm.
/// UserError: see storage_failure.
void close_as_one_file(std::unique_ptr<SQLite::Database> database, const std::string& path);

/// Returns the size of a journal or a log; 0 without one.
std::uintmax_t journal_bytes(const std::string& path);

/// Returns whether a file's header requires a log, nobody writes the file, and the log is missing:
/// a copy made while a search was writing, or a file whose log another program folded in. Not while
/// this process reads the file: see is_being_written.
bool lacks_log(const std::string& path);

}  // namespace misalign::schema
