// Finds out whether a catalogue's storage is local or shared, and words its failures.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

enum class Storage {
  local,   ///< one machine's: a write-ahead log, readers never wait
  network  ///< shared by machines: WAL corrupts there, so a rollback journal, and no reader
           ///< meanwhile
};

struct FileSystem {
  std::string name;  ///< "nfs"; "fuse"; "0x1234" if it is none of those known
  Storage storage;
  std::uint64_t free_bytes;
};

/// Returns the file system of the directory that holds `path`, by statfs; local if it is not known
/// to be shared.
FileSystem file_system_of(const std::string& path);

/// Returns the file system with that f_type of statfs.
FileSystem file_system_of_type(std::uint64_t type);

/// Returns SQLite's error about a file as a sentence that says what was kept and what to do: a
/// failure in most cases, bad input for a damaged file (also one without a table or column), in use
/// if another program keeps it locked. For an OutputFile's database it names the output, of which
/// nothing is kept.
UserError storage_failure(const std::string& path, const SQLite::Exception& error);

/// Calls `work`; exceptions of SQLite become errors about `path`.
template <class Work>
auto guarded(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const SQLite::Exception& error) {
    throw storage_failure(path, error);
  }
}

}  // namespace misalign::schema
