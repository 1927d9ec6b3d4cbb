#include "tests/simulation/disk.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "tests/simulation/disk_log.hpp"

namespace misalign::simulation {
namespace {

Disk* disk = nullptr;
std::vector<Fault> faults;  // of this life
bool is_counted = true;

// An open file; 0: none of this disk.
struct OpenFile {
  std::uint64_t file = 0;
  Part part = Part::plain;
};
std::array<OpenFile, 4096> open_files;

OpenFile* ours(int descriptor) {
  if (!disk || descriptor < 0 || descriptor >= static_cast<int>(open_files.size())) return nullptr;
  OpenFile& file = open_files[static_cast<std::size_t>(descriptor)];
  return file.file == 0 ? nullptr : &file;
}

// The name within the folder; empty for another place's path.
std::string name_of(const char* path) {
  std::string_view name = path;
  if (!disk) return "";
  if (name == disk->folder()) return ".";
  if (name.starts_with(disk->folder() + "/")) name.remove_prefix(disk->folder().size() + 1);
  if (name.starts_with("./")) name.remove_prefix(2);
  return name.starts_with("/") || name.empty() ? "" : std::string(name);
}

Part part_of(const std::string& name) {
  if (name.ends_with("-journal")) return Part::journal;
  if (name.ends_with("-wal")) return Part::log;
  if (name.ends_with("-shm")) return Part::index;
  return name.find(".db") != std::string::npos ? Part::database : Part::plain;
}

std::uint64_t inode_of(const struct stat& found) { return found.st_ino; }

std::uint64_t file_named(const std::string& name) {
  struct stat found {};
  return ::lstat((disk->folder() + "/" + name).c_str(), &found) == 0 ? inode_of(found) : 0;
}

void go_dark(FaultKind kind) {
  disk->state().has_ended = true;
  disk->state().lost_power = kind == FaultKind::power_cut;
  ::kill(::getpid(), SIGKILL);
}

// One call: counts it, and lets happen what was planned, before it or after it.
class FileCall {
 public:
  FileCall(Call call, Part part) {
    pass(call == Call::sync ? 2 * kMillisecond : 20'000);
    if (!is_counted) return;
    DiskState& state = disk->state();
    const std::uint64_t now = ++state.calls;
    ++state.seen[state.work][static_cast<int>(part)][static_cast<int>(call)];
    for (Fault& fault : faults) {
      const bool is_due = now >= fault.at && (!fault.is_spent || now <= fault.at + fault.lasts);
      if (!is_due || !fits(fault.kind, call, part)) continue;
      if (!fault.is_spent) fault.at = now;
      fault.is_spent = true;
      ++state.hits[state.work][static_cast<int>(part)][static_cast<int>(call)]
                  [static_cast<int>(fault.kind)];
      const bool ends = fault.kind == FaultKind::kill || fault.kind == FaultKind::power_cut;
      if (ends && !fault.after_call) go_dark(fault.kind);
      ends_after_ = ends;
      // SQLite repeats a short write; it is no failure.
      state.errors += !ends && fault.kind != FaultKind::short_write;
      fault_ = &fault;
      break;
    }
  }
  ~FileCall() {
    if (ends_after_) go_dark(fault_->kind);
  }
  FileCall(const FileCall&) = delete;
  FileCall& operator=(const FileCall&) = delete;

  /// Returns whether the call fails, with errno.
  bool fails() const {
    if (is(FaultKind::io_error) || is(FaultKind::failed_sync)) return errno = EIO, true;
    return is(FaultKind::no_space) && (errno = ENOSPC, true);
  }
  bool is(FaultKind kind) const { return fault_ && fault_->kind == kind; }

 private:
  const Fault* fault_ = nullptr;
  bool ends_after_ = false;
};

void log(const LogEntry& entry) { DiskLog(disk->state()).add(entry); }

int open_ours(const std::string& name, const char* path, int flags, mode_t mode) {
  const bool is_new = (flags & O_CREAT) != 0 && file_named(name) == 0;
  FileCall call(Call::open, part_of(name));
  if (call.fails()) return -1;
  const auto descriptor = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  struct stat found {};
  if (descriptor < 0 || ::fstat(descriptor, &found) != 0) return descriptor;
  if (static_cast<std::size_t>(descriptor) >= open_files.size()) std::abort();
  const Part part = S_ISDIR(found.st_mode) ? Part::folder : part_of(name);
  open_files[static_cast<std::size_t>(descriptor)] = {inode_of(found), part};
  if (is_new && S_ISREG(found.st_mode)) log({LogEntry::name, inode_of(found), 0, name});
  if ((flags & O_TRUNC) != 0) log({LogEntry::truncate, inode_of(found)});
  return descriptor;
}

// Writes at a place, or (below 0) where the file stands.
ssize_t write_to(OpenFile& file, int descriptor, const void* bytes, std::size_t size, off_t at) {
  FileCall call(Call::write, file.part);
  if (call.fails()) return -1;
  if (call.is(FaultKind::short_write)) size = std::max<std::size_t>(size / 2, 1);
  const off_t place = at >= 0 ? at : ::lseek(descriptor, 0, SEEK_CUR);
  const ssize_t written = at >= 0 ? syscall(SYS_pwrite64, descriptor, bytes, size, at)
                                  : syscall(SYS_write, descriptor, bytes, size);
  if (written > 0 && file.part != Part::index) {
    log({LogEntry::write,
         file.file,
         static_cast<std::uint64_t>(place),
         {static_cast<const char*>(bytes), static_cast<std::size_t>(written)}});
  }
  return written;
}

int sync_file(OpenFile& file, int descriptor) {
  FileCall call(Call::sync, file.part);
  if (call.is(FaultKind::failed_sync)) log({LogEntry::fail_sync, file.file});
  if (call.fails()) return -1;
  log({file.part == Part::folder ? LogEntry::sync_names : LogEntry::sync, file.file});
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

int rename_ours(const char* from, const char* to, unsigned flags) {
  const std::string old_name = name_of(from), new_name = name_of(to);
  FileCall call(Call::rename, part_of(new_name));
  if (call.fails()) return -1;
  const auto result = static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, flags));
  if (result == 0) log({LogEntry::rename, 0, 0, old_name, new_name});
  return result;
}

}  // namespace

bool fits(FaultKind kind, Call call, Part part) {
  const bool changes = call != Call::read && call != Call::open;
  switch (kind) {
    case FaultKind::io_error:
      return true;
    case FaultKind::no_space:
      return call == Call::write || (call == Call::truncate && part == Part::index);
    case FaultKind::short_write:
      return call == Call::write;
    case FaultKind::failed_sync:
      return call == Call::sync && part != Part::folder;
    case FaultKind::kill:
    case FaultKind::power_cut:
      return changes;
  }
  return false;
}

Disk::Disk(std::string folder)
    : folder_(std::move(folder)),
      state_(static_cast<DiskState*>(::mmap(nullptr, sizeof(DiskState), PROT_READ | PROT_WRITE,
                                            MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0))) {
  if (state_ == MAP_FAILED) std::abort();
}

void Disk::use() {
  disk = this;
  clear();
}

DiskState* state_here() { return disk ? &disk->state() : nullptr; }

void Disk::clear() {
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
  state_->log_size = 0;
  faults.clear();
}

void Disk::sync_names() { log({LogEntry::sync_names}); }

void Disk::put(const std::string& name, const std::string& bytes) {
  const int descriptor =
      ::open((folder_ + "/" + name).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (::write(descriptor, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    std::abort();
  }
  ::fsync(descriptor);
  ::close(descriptor);
  log({LogEntry::sync_names});
}

void Disk::visit() {
  is_counted = false;
  faults.clear();
}

void Disk::begin_life(int work, std::vector<Fault> of_life) {
  state_->calls = state_->draws_made = state_->errors = 0;
  state_->asked_at = state_->ended_at = -1;
  state_->work = work;
  state_->has_ended = state_->lost_power = false;
  faults = std::move(of_life);
}

}  // namespace misalign::simulation

// The C library's functions of these names; files of other folders are not touched.
extern "C" {
using namespace misalign::simulation;

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & (O_CREAT | O_TMPFILE)) != 0) {
    va_list arguments;
    va_start(arguments, flags);
    mode = va_arg(arguments, mode_t);
    va_end(arguments);
  }
  const std::string name = name_of(path);
  if (!name.empty()) return open_ours(name, path, flags, mode);
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
int open64(const char* path, int flags, ...) __attribute__((alias("open")));

int close(int descriptor) {
  if (OpenFile* file = ours(descriptor)) *file = {};
  return static_cast<int>(syscall(SYS_close, descriptor));
}

ssize_t read(int descriptor, void* bytes, size_t size) {
  if (OpenFile* file = ours(descriptor); file && FileCall(Call::read, file->part).fails())
    return -1;
  return syscall(SYS_read, descriptor, bytes, size);
}
ssize_t pread64(int descriptor, void* bytes, size_t size, off64_t at) {
  if (OpenFile* file = ours(descriptor); file && FileCall(Call::read, file->part).fails())
    return -1;
  return syscall(SYS_pread64, descriptor, bytes, size, at);
}
ssize_t pread(int, void*, size_t, off_t) __attribute__((alias("pread64")));

ssize_t write(int descriptor, const void* bytes, size_t size) {
  OpenFile* const file = ours(descriptor);
  return file ? write_to(*file, descriptor, bytes, size, -1)
              : syscall(SYS_write, descriptor, bytes, size);
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t at) {
  OpenFile* const file = ours(descriptor);
  return file ? write_to(*file, descriptor, bytes, size, at)
              : syscall(SYS_pwrite64, descriptor, bytes, size, at);
}
ssize_t pwrite(int, const void*, size_t, off_t) __attribute__((alias("pwrite64")));

int ftruncate64(int descriptor, off64_t size) noexcept {
  OpenFile* const file = ours(descriptor);
  if (!file) return static_cast<int>(syscall(SYS_ftruncate, descriptor, size));
  FileCall call(Call::truncate, file->part);
  if (call.fails()) return -1;
  if (file->part != Part::index)
    log({LogEntry::truncate, file->file, static_cast<std::uint64_t>(size)});
  return static_cast<int>(syscall(SYS_ftruncate, descriptor, size));
}
int ftruncate(int, off_t) noexcept __attribute__((alias("ftruncate64")));

int fsync(int descriptor) {
  OpenFile* const file = ours(descriptor);
  return file ? sync_file(*file, descriptor) : static_cast<int>(syscall(SYS_fsync, descriptor));
}
int fdatasync(int) __attribute__((alias("fsync")));

int unlink(const char* path) noexcept {
  const std::string name = name_of(path);
  if (name.empty()) return static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, 0));
  FileCall call(Call::remove, part_of(name));
  if (call.fails()) return -1;
  const auto result = static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, 0));
  if (result == 0) log({LogEntry::remove, 0, 0, name});
  return result;
}

int rename(const char* from, const char* to) noexcept { return renameat2(0, from, 0, to, 0); }
int renameat2(int, const char* from, int, const char* to, unsigned flags) noexcept {
  if (!name_of(from).empty()) return rename_ours(from, to, flags);
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, flags));
}

// A file without a name gets one; the program links nothing else.
int linkat(int, const char* from, int, const char* to, int flags) noexcept {
  const std::string name = name_of(to);
  if (name.empty() || std::strncmp(from, "/proc/self/fd/", 14) != 0) return errno = EPERM, -1;
  FileCall call(Call::rename, part_of(name));
  if (call.fails()) return -1;
  const auto result = static_cast<int>(syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, flags));
  if (result == 0) log({LogEntry::name, file_named(name), 0, name});
  return result;
}
}
