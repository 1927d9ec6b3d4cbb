// Opening SQLite files with sentences for what can go wrong, and reading without any risk of
// writing.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <memory>
#include <string>

#include "schema/input.hpp"

namespace misalign::schema {

inline constexpr int kApplicationId = 0x4D53414C;
inline constexpr int kSchemaVersion = 2;

/// A catalogue opened for reading: it cannot write, attach other files or load extensions.
/// UserError: 3 no such file or no catalogue, 5 a newer schema.
std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path);

/// The one writer's connection: synchronous FULL, foreign keys. Changes nothing in the file yet.
/// Creates the file if there is none. UserError: 1 the directory cannot be written, 3 no catalogue,
/// 5 a newer schema.
std::unique_ptr<SQLite::Database> open_for_writing(const std::string& path);

/// An exclusive advisory lock on the catalogue's file that dies with the process.
class WriterLock {
 public:
  /// Creates an empty file if there is none. UserError: 1 cannot be opened, 4 held by another
  /// search.
  explicit WriterLock(const std::string& path);
  /// Closing any descriptor of the file drops SQLite's own locks in this process: so this object
  /// must outlive the connection.
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace misalign::schema
