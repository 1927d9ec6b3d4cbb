// System calls of SQLite's that can be made to fail, as a disk or a broken file system lets them:
// below what the program puts round them.
#pragma once

#include <sqlite3.h>
#include <sys/types.h>

#include <cerrno>

namespace misalign::schema {

/// Reads (pread) and writes (pwrite) while it lives; one at a time. Connections that are opened
/// while it lives are affected.
class FaultyCalls {
 public:
  FaultyCalls() {
    for (const char* name : {"pread", "pread64"})
      put<ssize_t (*)(int, void*, size_t, off_t)>(name, read, real_read());
    for (const char* name : {"pwrite", "pwrite64"})
      put<ssize_t (*)(int, const void*, size_t, off_t)>(name, write, real_write());
    arm({}, 0, 0);
  }
  ~FaultyCalls() {
    for (const char* name : {"pread", "pread64", "pwrite", "pwrite64"}) {
      vfs()->xSetSystemCall(vfs(), name, nullptr);
    }
  }
  FaultyCalls(const FaultyCalls&) = delete;
  FaultyCalls& operator=(const FaultyCalls&) = delete;

  enum class Kind { read, write };
  /// From the nth call of that kind on, all fail so; 0: none.
  void arm(Kind kind, int nth, int error) { state() = {kind, nth, error, 0}; }
  /// Calls of the armed kind since then.
  int count() const { return state().seen; }

 private:
  struct State {
    Kind kind;
    int nth, error, seen;
  };
  static State& state() {
    static State armed{};
    return armed;
  }
  static sqlite3_vfs* vfs() { return sqlite3_vfs_find("unix"); }
  static auto real_read() -> ssize_t (*&)(int, void*, size_t, off_t) {
    static ssize_t (*real)(int, void*, size_t, off_t) = nullptr;
    return real;
  }
  static auto real_write() -> ssize_t (*&)(int, const void*, size_t, off_t) {
    static ssize_t (*real)(int, const void*, size_t, off_t) = nullptr;
    return real;
  }

  template <class Call>
  static void put(const char* name, Call faulty, Call& real) {
    vfs()->xSetSystemCall(vfs(), name, nullptr);
    const auto now = vfs()->xGetSystemCall(vfs(), name);
    if (!now) return;  // this SQLite uses the other one
    real = reinterpret_cast<Call>(now);
    vfs()->xSetSystemCall(vfs(), name, reinterpret_cast<sqlite3_syscall_ptr>(faulty));
  }
  static bool fails(Kind kind) {
    if (kind != state().kind) return false;
    ++state().seen;
    if (state().nth == 0 || state().seen < state().nth) return false;
    errno = state().error;
    return true;
  }
  static ssize_t read(int file, void* into, size_t size, off_t at) {
    return fails(Kind::read) ? -1 : real_read()(file, into, size, at);
  }
  static ssize_t write(int file, const void* from, size_t size, off_t at) {
    return fails(Kind::write) ? -1 : real_write()(file, from, size, at);
  }
};

}  // namespace misalign::schema
