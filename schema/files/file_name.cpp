#include "schema/files/file_name.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "schema/files/hexadecimal.hpp"
#include "schema/files/user_error.hpp"

namespace misalign::schema {
namespace {

constexpr std::size_t kLongestStem = 200;  // with additions, a name of at most 255 bytes
constexpr std::size_t kRandomDigits = 32;
constexpr const char* kEnding = ".partial";
constexpr int kMostLinks = 40;  // the limit of Linux

int errno_unless(bool done) { return done ? 0 : errno; }

std::string stem_of(const std::string& output) {
  const std::filesystem::path path = output;
  return path.parent_path() / (path.filename().string().substr(0, kLongestStem) + ".");
}

// Returns the part before the digits of a name of that form; empty for others.
std::string stem_within(const std::string& path) {
  const std::size_t added = kRandomDigits + std::string_view(kEnding).size();
  if (path.size() <= added || !path.ends_with(kEnding)) return "";
  const std::size_t stem = path.size() - added;
  const bool is_random = path.find_first_not_of(kHexDigits, stem) == stem + kRandomDigits;
  return is_random && path[stem - 1] == '.' ? path.substr(0, stem) : "";
}

bool is_missing(int error) { return error == EINVAL || error == ENOSYS || error == EOPNOTSUPP; }

int give_new_name(const std::string& from, const std::string& to) {
  int error = rename_to_new(from, to);
  if (is_missing(error)) error = link_to_new(from, to);
  if (is_missing(error) || error == EPERM || error == EMLINK) error = rename_over_empty(from, to);
  return error;
}

const char* what_it_is(std::filesystem::file_type type) {
  using Type = std::filesystem::file_type;
  switch (type) {
    case Type::directory:
      return "a directory";
    case Type::fifo:
      return "a pipe";
    case Type::socket:
      return "a socket";
    default:
      return "a device";
  }
}

}  // namespace

std::string unforeseen_name(const std::string& output) {
  std::array<unsigned char, kRandomDigits / 2> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw UserError(Cause::failure, output + ": cannot be written (no random numbers: " +
                                        std::strerror(errno) + "); see to the system");
  }
  return stem_of(output) + hex(bytes) + kEnding;
}

bool is_unforeseen_name(const std::string& path, const std::string& output) {
  return stem_within(path) == stem_of(output);
}

std::string output_of(const std::string& path) {
  const std::string stem = stem_within(path);
  return stem.empty() ? path : stem.substr(0, stem.size() - 1);
}

const std::vector<std::string>& journal_suffixes() {
  static const std::vector<std::string> suffixes = {"-journal", "-wal", "-shm"};
  return suffixes;
}

int rename_to_new(const std::string& from, const std::string& to) {
  return errno_unless(::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) ==
                      0);
}

int link_to_new(const std::string& from, const std::string& to) {
  if (::link(from.c_str(), to.c_str()) != 0) return errno;
  return errno_unless(::unlink(from.c_str()) == 0);
}

int rename_over_empty(const std::string& from, const std::string& to) {
  const int made = ::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (made < 0) return errno;
  ::close(made);
  const int error = errno_unless(::rename(from.c_str(), to.c_str()) == 0);
  if (error != 0) ::unlink(to.c_str());
  return error;
}

void sync_directory_of(const std::string& path) {
  const auto directory = std::filesystem::absolute(path).parent_path();
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

int give_name(const std::string& from, const std::string& to, Existing existing) {
  const int error = existing == Existing::refused
                        ? give_new_name(from, to)
                        : errno_unless(::rename(from.c_str(), to.c_str()) == 0);
  if (error == 0) sync_directory_of(to);
  return error;
}

bool is_taken(const std::string& path) {
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0;
}

void check_is_file(const std::string& path, const std::string& suggestion) {
  const auto refuse = [&](const std::string& what) {
    throw UserError(Cause::bad_input, path + ": " + what + "; " + suggestion);
  };
  if (path.find('\0') != std::string::npos) {
    refuse("cannot be a file (its name contains a zero byte)");
  }
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  if (error == std::errc::too_many_symbolic_link_levels) {
    refuse("is a link that leads nowhere (links go round in a circle)");
  }
  using Type = std::filesystem::file_type;
  // A path that may not be read counts as missing.
  if (type == Type::regular || type == Type::not_found || type == Type::none) return;
  refuse(std::string("is ") + what_it_is(type) + " (no regular file)");
}

std::string end_of_links(const std::string& path) {
  std::filesystem::path end = path;
  std::error_code error;
  for (int k = 0; std::filesystem::is_symlink(end, error); ++k) {
    if (k == kMostLinks) {
      throw UserError(Cause::failure,
                      path + ": leads nowhere (links go round in a circle); name another file");
    }
    end = end.parent_path() / std::filesystem::read_symlink(end, error);
  }
  return end;
}

}  // namespace misalign::schema
