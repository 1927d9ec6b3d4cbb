// SQLite's write-ahead log beside a catalogue: kept small, and missed where it is not there.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "schema/files/storage.hpp"

namespace misalign::schema {

/// Of a catalogue that is written on a local disk; on others there is none and nothing is done.
class WriteAheadLog {
 public:
  WriteAheadLog(SQLite::Database& database, const std::string& path, Storage storage)
      : database_(database), path_(path), storage_(storage) {}

  /// Folds it into the file and empties it, unless a reader keeps it. Throws SQLite::Exception.
  void fold_in();
  /// Copies into the file what no reader needs in the log, which stays.
  void copy_into_file();
  /// Folds it in after a commit, once it has grown too large.
  void keep_small();

 private:
  SQLite::Database& database_;
  const std::string path_;
  const Storage storage_;
  std::uintmax_t kept_bytes_ = 0;  // when it could last not be folded in
};

/// The size of a journal or a log; 0 where there is none.
std::uintmax_t journal_bytes(const std::string& path);

/// True where a file says that it has a log, nobody writes it, and the log is missing. A copy that
/// was made while a search was writing is such a file; so is one whose log another program folded
/// in. Not while this process reads the file: see is_being_written.
bool lacks_log(const std::string& path);

}  // namespace misalign::schema
