// The storage on which a catalogue lies, local or shared, and sentences for its failures.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

enum class Storage {
  local,   ///< one machine's own: a write-ahead log, readers never wait
  network  ///< shared by machines: WAL corrupts there, so a rollback journal, and no reader
           ///< meanwhile
};

struct FileSystem {
  std::string name;  ///< "nfs"; "fuse"; "0x1234" if it is none of those known
  Storage storage;
  std::uint64_t free_bytes;
};

/// Of the directory that holds `path`, by statfs. What is not known to be shared is local.
FileSystem file_system_of(const std::string& path);

/// What statfs's f_type stands for.
FileSystem file_system_of_type(std::uint64_t type);

/// What SQLite says of a file, as a sentence that says what was kept and what to do: a failure in
/// most cases, a bad input of a damaged file (also one in which a table or column is missing), in
/// use where another program keeps it locked. Of an OutputFile's database it names the output, of
/// which nothing is kept.
UserError storage_failure(const std::string& path, const SQLite::Exception& error);

/// Calls `work`; what SQLite throws becomes a UserError about `path`.
template <class Work>
auto guarded(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const SQLite::Exception& error) {
    throw storage_failure(path, error);
  }
}

}  // namespace misalign::schema
