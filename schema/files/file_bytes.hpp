// Reads files of any kind as bytes, and reports every failure of the file system.
#pragma once

#include <cerrno>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>

namespace misalign::schema {

/// Repeats a call that a signal interrupted, as POSIX requires. A file system that always answers
/// so is broken: after half a second errno is EIO.
template <class Call>
auto uninterrupted(const Call& call) {
  constexpr int kMost = 500, kAtOnce = 100;
  constexpr std::chrono::milliseconds kPause{1};
  auto result = call();
  for (int times = 1; result < 0 && errno == EINTR; ++times) {
    if (times > kMost) {
      errno = EIO;
      break;
    }
    if (times > kAtOnce) std::this_thread::sleep_for(kPause);
    result = call();
  }
  return result;
}

/// First bytes of an SQLite database; the zero is part of them.
inline constexpr std::string_view kDatabaseHeader("SQLite format 3", 16);  // NOLINT: with its zero

enum class FileKind {
  any,     ///< named by a person: also a pipe
  regular  ///< named by a file
};

/// Reads a whole file. UserError (bad_input) if it cannot be opened or read, is not of that kind,
/// or is larger.
std::string read_file(const std::string& path, std::size_t most_bytes, FileKind kind);

/// Reads a file's last bytes, all of a shorter one, none of a missing one. UserError (failure) if
/// it cannot be read.
std::string end_of_file(const std::string& path, std::size_t bytes);

}  // namespace misalign::schema
