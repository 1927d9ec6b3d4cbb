// Reads files as bytes, whatever kind of file it is and however the file system fails.
#pragma once

#include <cerrno>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>

namespace misalign::schema {

/// Calls again what a signal interrupted, as POSIX asks for. A file system that answers so for ever
/// is broken: after half a second errno is EIO.
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

/// What an SQLite database begins with; the zero is a part of it.
inline constexpr std::string_view kDatabaseHeader("SQLite format 3", 16);  // NOLINT: with its zero

enum class FileKind {
  any,     ///< what a person has named: a pipe, too
  regular  ///< what a file has named
};

/// All of it. UserError (bad_input) if it cannot be opened or read, is not of that kind, or is
/// larger.
std::string read_file(const std::string& path, std::size_t most_bytes, FileKind kind);

/// Its last bytes, all of a shorter one, none of one that is not there. UserError (failure) if it
/// cannot be read.
std::string end_of_file(const std::string& path, std::size_t bytes);

}  // namespace misalign::schema
