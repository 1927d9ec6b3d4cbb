// Lets one process at a time write a catalogue.
#pragma once

#include <string>

namespace misalign::schema {

enum class Missing {
  created,  ///< a missing file is created
  refused
};

/// An exclusive advisory lock on the catalogue's file that ends with the process: an open-file lock
/// of one byte far behind those that SQLite locks.
class WriterLock {
 public:
  /// Locks the file. UserError: failure if it cannot be opened, or has a second name (a hard link:
  /// SQLite's journals are named after the first, and whoever opens the other name would not find
  /// them); bad_input if it is no regular file, or is missing and may not be created; in_use if
  /// another process holds the lock.
  explicit WriterLock(const std::string& path, Missing missing = Missing::created);
  /// Closes the file, which drops SQLite's own locks in this process: this object must outlive the
  /// connection.
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

  /// Returns whether this lock created the file.
  bool made_the_file() const { return made_the_file_; }
  /// Checks that the path still leads to the locked file; otherwise SQLite would write to a file
  /// that nobody can find. UserError (failure).
  void check_file_is_there() const;

 private:
  void check_kind() const;
  void lock() const;

  const std::string path_;
  bool made_the_file_ = false;
  int descriptor_;
};

/// Returns whether a process holds the lock of this file; false if that cannot be tested. Not while
/// this process has a connection to the file: see ~WriterLock.
bool is_being_written(const std::string& path);

}  // namespace misalign::schema
