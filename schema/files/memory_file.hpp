// Makes a file in memory, for libraries that can only write to a path.
#pragma once

#include <string>

namespace misalign::schema {

class MemoryFile {
 public:
  /// Makes an empty file. `name` is that of the final file, for sentences. UserError (failure) if
  /// the system gives none.
  explicit MemoryFile(const std::string& name);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  /// Returns its path, valid in this process while this object lives.
  std::string path() const;
  /// Returns all bytes written so far. UserError (failure).
  std::string bytes() const;

 private:
  [[noreturn]] void refuse(int error) const;

  const std::string name_;
  int descriptor_;
};

}  // namespace misalign::schema
