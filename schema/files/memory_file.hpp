// A file in memory alone, for libraries that write to nothing but a path.
#pragma once

#include <string>

namespace misalign::schema {

class MemoryFile {
 public:
  /// An empty one. `name` is that of the file that it is to become, for sentences. UserError
  /// (failure) if the system gives none.
  explicit MemoryFile(const std::string& name);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  /// Where to open it, in this process, while this object lives.
  std::string path() const;
  /// All that was written to it by now. UserError (failure).
  std::string bytes() const;

 private:
  [[noreturn]] void refuse(int error) const;

  const std::string name_;
  int descriptor_;
};

}  // namespace misalign::schema
