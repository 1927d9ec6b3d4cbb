// A mark of a catalogue's files: tells that they have changed, without opening them.
#pragma once

#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <string>

namespace misalign::search {

/// Of the catalogue's file and of the log beside it, in which commits are first.
class FileMark {
 public:
  /// Of no file: like none.
  FileMark() = default;
  /// Not while this process has a connection to the file (see schema::is_being_written).
  static FileMark of(const std::string& path);

  bool exists() const { return exists_; }
  /// Whether a search or another verb that writes is at work.
  bool is_written() const { return is_written_; }
  /// Whether nothing has changed in between. A file system's clock ticks a few times in a hundredth
  /// of a second: what was changed just before it was looked at is like nothing, not even itself.
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
