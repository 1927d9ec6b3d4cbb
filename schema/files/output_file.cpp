#include "schema/files/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "schema/files/file_bytes.hpp"
#include "schema/files/input.hpp"
#include "schema/files/kept_inputs.hpp"
#include "schema/files/storage.hpp"

namespace misalign::schema {
namespace {

constexpr int kMostTries = 100;
constexpr int kCreate = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;

// Locks one byte far behind the data, beside that of a catalogue's writer. Returns 0, or an errno.
int lock(int descriptor) {
  struct flock byte {};
  byte.l_type = F_WRLCK;
  byte.l_whence = SEEK_SET;
  byte.l_start = (1LL << 62) + 1;
  byte.l_len = 1;
  return ::fcntl(descriptor, F_OFD_SETLK, &byte) == 0 ? 0 : errno;
}

bool is_locked(int error) { return error == EAGAIN || error == EACCES; }

using Stat = struct stat;

bool same_file(const Stat& a, const Stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

std::optional<Stat> stat_of(const std::string& path) {
  Stat found{};
  return ::lstat(path.c_str(), &found) == 0 ? std::optional(found) : std::nullopt;
}

bool leads_to(const std::string& path, int descriptor) {
  Stat opened{};
  const auto named = stat_of(path);
  return named && ::fstat(descriptor, &opened) == 0 && same_file(*named, opened);
}

void remove_database(const std::string& path) {
  for (const std::string& suffix : journal_suffixes()) ::unlink((path + suffix).c_str());
  ::unlink(path.c_str());
}

bool is_one_of(const Stat& file, const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    Stat other{};
    if (::stat(path.c_str(), &other) == 0 && same_file(file, other)) return true;
  }
  return false;
}

// Removes what a killed process left of this output. Returns false if a living process is writing
// it.
bool remove_leftover(const std::string& path, const std::vector<std::string>& originals) {
  // Checked before opening: closing an original would drop SQLite's locks on it.
  const auto found = stat_of(path);
  const bool ours = found && S_ISREG(found->st_mode) && found->st_uid == ::geteuid() &&
                    found->st_nlink == 1 && !is_one_of(*found, originals);
  if (!ours) return true;
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return true;
  const int error = lock(descriptor);
  if (error == 0 && leads_to(path, descriptor)) remove_database(path);
  ::close(descriptor);
  return !is_locked(error);
}

// Removes leftovers; returns false if another process is writing this output.
bool remove_leftovers(const std::string& output, const std::vector<std::string>& originals) {
  if (file_system_of(output).storage == Storage::network) return true;
  const std::filesystem::path folder = std::filesystem::path(output).parent_path();
  std::error_code error;
  std::filesystem::directory_iterator entries(folder.empty() ? "." : folder, error), end;
  for (; !error && entries != end; entries.increment(error)) {
    const std::string path = folder / entries->path().filename();
    if (is_unforeseen_name(path, output) && !remove_leftover(path, originals)) return false;
  }
  return true;
}

// The file at a path; `error` if that is unknown, for then it may be a database.
struct ExistingFile {
  bool is_database = false;
  int error = 0;
};

ExistingFile existing_file(const std::string& path) {
  Stat found{};
  if (::stat(path.c_str(), &found) != 0) {
    const bool is_nothing = errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG;
    return {.error = is_nothing ? 0 : errno};
  }
  if (!S_ISREG(found.st_mode)) return {};
  const int descriptor =
      uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); });
  if (descriptor < 0) return {.error = errno};
  std::array<char, kDatabaseHeader.size()> bytes{};
  const ssize_t count =
      uninterrupted([&] { return ::read(descriptor, bytes.data(), bytes.size()); });
  const int error = count < 0 ? errno : 0;
  ::close(descriptor);
  const std::string_view begin(bytes.data(), count < 0 ? 0 : static_cast<std::size_t>(count));
  return {begin == kDatabaseHeader, error};
}

// Refuses to replace a database, a journal of one, or a file that may be either by a text.
void refuse_database(const std::string& path, const std::string& output) {
  std::vector<std::string> paths{path};
  for (const std::string& suffix : journal_suffixes()) {
    if (path.ends_with(suffix)) paths.push_back(path.substr(0, path.size() - suffix.size()));
  }
  for (const std::string& database : paths) {
    const ExistingFile found = existing_file(database);
    if (found.is_database) {
      throw UserError(Cause::bad_request,
                      output + ": is a database, or belongs to one; name another file with " +
                          parameter("output"));
    }
    if (found.error != 0) {
      throw UserError(Cause::failure,
                      output + ": cannot be written (" + database +
                          " may be a database, and cannot be read: " + std::strerror(found.error) +
                          "); name another file with " + parameter("output"));
    }
  }
}

// Returns the permissions of those who may read all of these files, and of the owner.
mode_t common_mode(const std::vector<std::string>& originals) {
  mode_t mode = 0666;
  for (const std::string& path : originals) {
    Stat found{};
    if (::stat(path.c_str(), &found) == 0) mode &= found.st_mode;
  }
  return mode | 0600;
}

}  // namespace

OutputFile::OutputFile(const std::string& output, Existing existing)
    : output_(output), target_(output), existing_(existing) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : output_(std::move(other.output_)),
      target_(std::move(other.target_)),
      existing_(other.existing_),
      path_(std::exchange(other.path_, "")),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile OutputFile::database(const std::string& output,
                                const std::vector<std::string>& originals) {
  OutputFile file(output, Existing::refused);
  if (is_taken(output)) file.refuse(EEXIST);
  for (const std::string& suffix : journal_suffixes()) {
    if (!is_taken(output + suffix)) continue;
    throw UserError(Cause::bad_request,
                    output + suffix + ": exists already (SQLite would take it for a part of " +
                        output + "); name a new file, or move that one away");
  }
  if (!remove_leftovers(output, originals)) {
    throw UserError(
        Cause::in_use,
        output + ": another process is writing it; wait for that one to end, or name another file");
  }
  file.make_named(common_mode(originals));
  return file;
}

OutputFile OutputFile::text(const std::string& output) {
  OutputFile file(output, Existing::replaced);
  file.target_ = end_of_links(output);
  const auto found = stat_of(file.target_);
  if (found && !S_ISREG(found->st_mode)) {
    throw UserError(Cause::failure,
                    output + ": cannot be written (it exists, and is no file); choose another " +
                        parameter("output"));
  }
  if (found && is_input(*found)) {
    throw UserError(Cause::bad_request,
                    output + ": is an input of this output (it would be lost); name another " +
                        parameter("output"));
  }
  refuse_database(file.target_, output);
  file.make_unnamed();
  if (found) {  // a user who may not restore its owner writes a file of his own
    [[maybe_unused]] const int ignored = ::fchown(file.descriptor_, found->st_uid, found->st_gid);
    ::fchmod(file.descriptor_, found->st_mode & 0777);
  }
  return file;
}

// A remover of leftovers may have come between making and locking the file: then it gets another
// name.
void OutputFile::make_named(mode_t mode) {
  for (int k = 0; k < kMostTries; ++k) {
    const std::string path = unforeseen_name(target_);
    descriptor_ = ::open(path.c_str(), kCreate, mode);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) refuse(errno);
    // Nothing is removed where locks fail: those of others cannot be tested there either.
    if (!is_locked(lock(descriptor_)) && leads_to(path, descriptor_)) {
      path_ = path;
      return;
    }
    ::close(std::exchange(descriptor_, -1));
  }
  refuse(EEXIST);
}

void OutputFile::make_unnamed() {
  const std::filesystem::path folder = std::filesystem::path(target_).parent_path();
  const bool can_be_named = ::access("/proc/self/fd", X_OK) == 0;
  descriptor_ = can_be_named ? ::open(folder.empty() ? "." : folder.c_str(),
                                      O_RDWR | O_TMPFILE | O_CLOEXEC, 0666)
                             : -1;
  if (descriptor_ < 0) make_named(0666);
}

OutputFile::~OutputFile() {
  if (!path_.empty() && leads_to(path_, descriptor_)) remove_database(path_);
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
    if (count < 0) refuse(errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

// Data in a journal is not in the file yet: a disk that failed while the last connection closed has
// left it there. An empty journal, or shared memory, means nothing.
void OutputFile::refuse_journals() const {
  for (const std::string& suffix : journal_suffixes()) {
    const auto found = stat_of(path_ + suffix);
    if (found && found->st_size > 0 && suffix != "-shm") {
      throw UserError(Cause::failure, output_ +
                                          ": could not be completed (a journal of it is left); see "
                                          "to the disk, then the same again");
    }
    if (found) ::unlink((path_ + suffix).c_str());
  }
}

void OutputFile::publish() {
  if (!path_.empty()) refuse_journals();
  if (::fsync(descriptor_) != 0 && errno != EINVAL) refuse(errno);
  if (path_.empty()) {
    const std::string path = unforeseen_name(target_);
    const std::string unnamed = "/proc/self/fd/" + std::to_string(descriptor_);
    if (::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) != 0) {
      refuse(errno);
    }
    path_ = path;
  }
  if (const int error = give_name(path_, target_, existing_)) refuse(error);
  path_.clear();
}

void OutputFile::refuse(int error) const {
  if (error == EEXIST)
    throw UserError(Cause::bad_request, output_ + ": exists already; name a new file");
  throw UserError(Cause::failure,
                  output_ + ": cannot be written (" + std::strerror(error) + "); choose another " +
                      (existing_ == Existing::replaced ? parameter("output") : "place"));
}

void write_text_file(const std::string& path, const std::string& text) {
  OutputFile file = OutputFile::text(path);
  file.write(text);
  file.publish();
}

}  // namespace misalign::schema
