#include "schema/partial_file.hpp"

#include <filesystem>

#include "schema/database.hpp"

namespace misalign::schema {

PartialFile::PartialFile(const std::string& output) : output_(output), path_(output + ".partial") {
  if (std::filesystem::exists(output)) {
    throw UserError(kExitUsage, output + ": exists already; name a new file");
  }
  { const WriterLock nobody_else(path_); }
  remove();
}

PartialFile::~PartialFile() {
  if (!done_) remove();
}

void PartialFile::finish() {
  std::error_code error;
  std::filesystem::rename(path_, output_, error);
  if (error) {
    throw UserError(kExitFailure, output_ + ": cannot be written (" + error.message() +
                                      "); choose another place");
  }
  done_ = true;
  sync_directory_of(output_);
}

void PartialFile::remove() const {
  std::error_code ignored;
  for (const char* suffix : {"", "-journal", "-wal", "-shm"}) {
    std::filesystem::remove(path_ + suffix, ignored);
  }
}

}  // namespace misalign::schema
