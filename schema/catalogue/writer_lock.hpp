// The lock that lets one process at a time write a catalogue.
#pragma once

#include <string>

namespace misalign::schema {

enum class Missing {
  created,  ///< a file that is not there is made
  refused
};

/// An exclusive advisory lock on the catalogue's file that dies with the process: an open-file lock
/// of one byte far behind those that SQLite locks.
class WriterLock {
 public:
  /// UserError: failure cannot be opened, or has a second name (a hard link: SQLite's journals go
  /// by the name, and whoever opens the other name would not find them); bad_input is no regular
  /// file, or is missing and may not be created; in_use held by another process.
  explicit WriterLock(const std::string& path, Missing missing = Missing::created);
  /// Closing any descriptor of the file drops SQLite's own locks in this process: so this object
  /// must outlive the connection.
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

  /// Whether there was no file before.
  bool made_the_file() const { return made_the_file_; }
  /// UserError (failure) if the path leads to another file now, or to none: SQLite would go on
  /// writing to a file that nobody can find.
  void check_file_is_there() const;

 private:
  void check_kind() const;
  void lock() const;

  const std::string path_;
  bool made_the_file_ = false;
  int descriptor_;
};

/// Whether a process holds the lock of this file; false where it cannot be asked. Not while this
/// process has a connection to the file: see ~WriterLock.
bool is_being_written(const std::string& path);

}  // namespace misalign::schema
