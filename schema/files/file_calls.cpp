#include "schema/files/file_calls.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/types.h>

#include <mutex>
#include <type_traits>

#include "schema/files/file_bytes.hpp"

namespace misalign::schema {
namespace {

using Call = sqlite3_syscall_ptr;

// SQLite takes EIO, ENXIO and ERANGE while reading for SQLITE_IOERR_CORRUPTFS, and that for
// SQLITE_CORRUPT. Another errno avoids this.
ssize_t read_again(const auto& call) {
  const ssize_t count = uninterrupted(call);
  if (count < 0 && (errno == EIO || errno == ENXIO || errno == ERANGE)) errno = EREMOTEIO;
  return count;
}

// Guards a system call of SQLite's table; `real` is the call before. The number tells calls of the
// same arguments apart.
template <int kNumber, class Result, class... Arguments>
struct GuardedCall {
  static inline Result (*real)(Arguments...) = nullptr;
  static Result guarded(Arguments... arguments) {
    const auto call = [&] { return real(arguments...); };
    if constexpr ((std::is_same_v<Arguments, void*> || ...)) {  // the call reads into it
      return read_again(call);
    } else {
      return uninterrupted(call);
    }
  }
};

template <class Guarded>
void guard(sqlite3_vfs* vfs, const char* name) {
  const Call now = vfs->xGetSystemCall(vfs, name);
  const Call ours = reinterpret_cast<Call>(Guarded::guarded);
  if (!now || now == ours) return;
  Guarded::real = reinterpret_cast<decltype(Guarded::real)>(now);
  vfs->xSetSystemCall(vfs, name, ours);
}

}  // namespace

void guard_file_calls() {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  sqlite3_vfs* vfs = sqlite3_vfs_find("unix");
  if (!vfs || vfs->iVersion < 3 || !vfs->xGetSystemCall || !vfs->xSetSystemCall) return;
  guard<GuardedCall<0, ssize_t, int, void*, size_t>>(vfs, "read");
  guard<GuardedCall<1, ssize_t, int, void*, size_t, off_t>>(vfs, "pread");
  guard<GuardedCall<2, ssize_t, int, void*, size_t, off64_t>>(vfs, "pread64");
  guard<GuardedCall<3, ssize_t, int, const void*, size_t>>(vfs, "write");
  guard<GuardedCall<4, ssize_t, int, const void*, size_t, off_t>>(vfs, "pwrite");
  guard<GuardedCall<5, ssize_t, int, const void*, size_t, off64_t>>(vfs, "pwrite64");
  guard<GuardedCall<6, int, const char*, int, int>>(vfs, "open");
  guard<GuardedCall<7, int, int, off_t>>(vfs, "ftruncate");
}

}  // namespace misalign::schema
