// Marks the state of a catalogue's files, to see changes without opening them.
#pragma once

#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <string>

namespace misalign::search {

/// The state of the catalogue's file and of its write-ahead log, which gets commits first.
class FileMark {
 public:
  /// The mark of no file, which equals no mark.
  FileMark() = default;
  /// Marks a file. This process must have no connection to it (see schema::is_being_written).
  static FileMark of(const std::string& path);

  bool exists() const { return exists_; }
  /// Returns whether a search or another verb is writing.
  bool is_written() const { return is_written_; }
  /// Returns whether the files have not changed in between. A file system's clock is coarse: a file
  /// changed just before its mark equals nothing, not even itself.
  bool is_like(const FileMark& later) const;

 private:
  struct Times {
    bool operator==(const Times&) const = default;
    std::uint64_t device = 0, inode = 0;
    std::int64_t bytes = 0, seconds = 0, nanoseconds = 0;
  };
  static Times times_of(const struct stat& file);

  std::array<Times, 2> files_{};
  bool exists_ = false, is_written_ = false, is_quiet_ = false;
};

}  // namespace misalign::search
