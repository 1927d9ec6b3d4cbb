// A database file that appears under its name only once it is whole.
#pragma once

#include <string>

namespace misalign::schema {

class PartialFile {
 public:
  /// UserError: 2 the output exists already, 4 another process is writing it, 1 it cannot be
  /// written. What a process that was killed has left of it is removed.
  explicit PartialFile(const std::string& output);
  /// Removes what is not finished.
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// Where to write it.
  const std::string& path() const { return path_; }
  /// Gives it its name. Every connection to it must be closed.
  void finish();

 private:
  void remove() const;

  const std::string output_, path_;
  bool done_ = false;
};

}  // namespace misalign::schema
