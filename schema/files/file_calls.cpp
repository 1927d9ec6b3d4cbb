#include "schema/files/file_calls.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/types.h>

#include <mutex>

#include "schema/files/file_bytes.hpp"

namespace misalign::schema {
namespace {

using Call = sqlite3_syscall_ptr;

// EIO, ENXIO and ERANGE while reading are SQLITE_IOERR_CORRUPTFS to SQLite, and from there on
// SQLITE_CORRUPT. With another errno they stay what they are.
ssize_t read_again(const auto& call) {
  const ssize_t count = uninterrupted(call);
  if (count < 0 && (errno == EIO || errno == ENXIO || errno == ERANGE)) errno = EREMOTEIO;
  return count;
}

// One system call of SQLite's table; `real` is what stood there before.
struct ReadCall {
  static constexpr const char* kName = "read";
  static inline ssize_t (*real)(int, void*, size_t) = nullptr;
  static ssize_t guarded(int file, void* into, size_t size) {
    return read_again([&] { return real(file, into, size); });
  }
};
struct PreadCall {
  static constexpr const char* kName = "pread";
  static inline ssize_t (*real)(int, void*, size_t, off_t) = nullptr;
  static ssize_t guarded(int file, void* into, size_t size, off_t at) {
    return read_again([&] { return real(file, into, size, at); });
  }
};
struct Pread64Call {
  static constexpr const char* kName = "pread64";
  static inline ssize_t (*real)(int, void*, size_t, off64_t) = nullptr;
  static ssize_t guarded(int file, void* into, size_t size, off64_t at) {
    return read_again([&] { return real(file, into, size, at); });
  }
};
struct WriteCall {
  static constexpr const char* kName = "write";
  static inline ssize_t (*real)(int, const void*, size_t) = nullptr;
  static ssize_t guarded(int file, const void* from, size_t size) {
    return uninterrupted([&] { return real(file, from, size); });
  }
};
struct PwriteCall {
  static constexpr const char* kName = "pwrite";
  static inline ssize_t (*real)(int, const void*, size_t, off_t) = nullptr;
  static ssize_t guarded(int file, const void* from, size_t size, off_t at) {
    return uninterrupted([&] { return real(file, from, size, at); });
  }
};
struct Pwrite64Call {
  static constexpr const char* kName = "pwrite64";
  static inline ssize_t (*real)(int, const void*, size_t, off64_t) = nullptr;
  static ssize_t guarded(int file, const void* from, size_t size, off64_t at) {
    return uninterrupted([&] { return real(file, from, size, at); });
  }
};
struct OpenCall {
  static constexpr const char* kName = "open";
  static inline int (*real)(const char*, int, int) = nullptr;
  static int guarded(const char* path, int flags, int mode) {
    return uninterrupted([&] { return real(path, flags, mode); });
  }
};
struct TruncateCall {
  static constexpr const char* kName = "ftruncate";
  static inline int (*real)(int, off_t) = nullptr;
  static int guarded(int file, off_t size) {
    return uninterrupted([&] { return real(file, size); });
  }
};

template <class Guarded>
void guard(sqlite3_vfs* vfs) {
  const Call now = vfs->xGetSystemCall(vfs, Guarded::kName);
  const Call ours = reinterpret_cast<Call>(Guarded::guarded);
  if (!now || now == ours) return;
  Guarded::real = reinterpret_cast<decltype(Guarded::real)>(now);
  vfs->xSetSystemCall(vfs, Guarded::kName, ours);
}

}  // namespace

void guard_file_calls() {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  sqlite3_vfs* vfs = sqlite3_vfs_find("unix");
  if (!vfs || vfs->iVersion < 3 || !vfs->xGetSystemCall || !vfs->xSetSystemCall) return;
  guard<ReadCall>(vfs);
  guard<PreadCall>(vfs);
  guard<Pread64Call>(vfs);
  guard<WriteCall>(vfs);
  guard<PwriteCall>(vfs);
  guard<Pwrite64Call>(vfs);
  guard<OpenCall>(vfs);
  guard<TruncateCall>(vfs);
}

}  // namespace misalign::schema
