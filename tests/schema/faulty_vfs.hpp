// An SQLite VFS whose operations can be made to fail: the n-th of a kind, once or from then on.
#pragma once

#include <sqlite3.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

namespace misalign::schema {

enum class DiskOperation {
  open,
  read,
  write,
  sync,
  truncate,
  remove,
  lock,
  file_size,
  shared_memory
};

inline constexpr DiskOperation kDiskOperations[] = {
    DiskOperation::open, DiskOperation::read,      DiskOperation::write,
    DiskOperation::sync, DiskOperation::truncate,  DiskOperation::remove,
    DiskOperation::lock, DiskOperation::file_size, DiskOperation::shared_memory};

struct DiskFault {
  DiskOperation operation = DiskOperation::open;
  int nth = 0;           ///< counted from 1; 0: none fails
  bool lasting = false;  ///< whether all that come after fail too
  int error = SQLITE_IOERR;
};

/// SQLite's default while it lives; one at a time.
class FaultyVfs {
 public:
  FaultyVfs() {
    real() = sqlite3_vfs_find(nullptr);
    vfs_ = *real();
    vfs_.zName = "faulty";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + real()->szOsFile;
    vfs_.xOpen = open;
    vfs_.xDelete = remove;
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~FaultyVfs() {
    disk() = {};
    sqlite3_vfs_register(real(), 1);
    sqlite3_vfs_unregister(&vfs_);
  }
  FaultyVfs(const FaultyVfs&) = delete;
  FaultyVfs& operator=(const FaultyVfs&) = delete;

  /// From now on; counts anew.
  void arm(const DiskFault& fault) {
    FaultyVfs::fault() = fault;
    seen() = 0;
  }
  void disarm() { arm({}); }
  /// From now on the files of a folder, without what is memory, hold so many bytes together.
  void limit_room(const std::string& folder, std::uint64_t bytes) { disk() = {folder, bytes}; }
  static std::uint64_t used(const std::string& folder) {
    std::uint64_t bytes = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
      if (!file.path().string().ends_with("-shm")) bytes += file.file_size();
    }
    return bytes;
  }
  /// Operations of the armed kind since then.
  int count() const { return seen(); }

 private:
  struct File {
    sqlite3_file base;
    sqlite3_file* wrapped() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };

  static sqlite3_vfs*& real() {
    static sqlite3_vfs* vfs = nullptr;
    return vfs;
  }
  static DiskFault& fault() {
    static DiskFault armed;
    return armed;
  }
  static int& seen() {
    static int count = 0;
    return count;
  }

  struct Disk {
    std::string folder;  // empty: there is room enough
    std::uint64_t bytes = 0;
  };
  static Disk& disk() {
    static Disk small;
    return small;
  }
  static sqlite3_file* of(sqlite3_file* file) { return reinterpret_cast<File*>(file)->wrapped(); }
  static bool has_room(sqlite3_file* file, int size, sqlite3_int64 at) {
    if (disk().folder.empty()) return true;
    sqlite3_int64 now = 0;
    of(file)->pMethods->xFileSize(of(file), &now);
    return at + size <= now ||
           used(disk().folder) + static_cast<std::uint64_t>(at + size - now) <= disk().bytes;
  }

  static bool fails(DiskOperation operation) {
    if (operation != fault().operation) return false;
    ++seen();
    return fault().nth > 0 && (fault().lasting ? seen() >= fault().nth : seen() == fault().nth);
  }

  // Calls the method of the wrapped file, unless it is the operation's turn to fail.
  template <auto method, DiskOperation operation, class... Arguments>
  static int call(sqlite3_file* file, Arguments... arguments) {
    if (fails(operation)) return fault().error;
    return (of(file)->pMethods->*method)(of(file), arguments...);
  }
  template <auto method, class... Arguments>
  static auto pass(sqlite3_file* file, Arguments... arguments) {
    return (of(file)->pMethods->*method)(of(file), arguments...);
  }

  // Half of it is written, as when a disk fills up.
  static int write(sqlite3_file* file, const void* bytes, int size, sqlite3_int64 at) {
    if (!has_room(file, size, at)) return SQLITE_FULL;
    if (!fails(DiskOperation::write))
      return pass<&sqlite3_io_methods::xWrite>(file, bytes, size, at);
    pass<&sqlite3_io_methods::xWrite>(file, bytes, size / 2, at);
    return fault().error;
  }

  static const sqlite3_io_methods* methods() {
    using M = sqlite3_io_methods;
    using O = DiskOperation;
    static const M all = {
        3,
        pass<&M::xClose>,
        call<&M::xRead, O::read, void*, int, sqlite3_int64>,
        write,
        call<&M::xTruncate, O::truncate, sqlite3_int64>,
        call<&M::xSync, O::sync, int>,
        call<&M::xFileSize, O::file_size, sqlite3_int64*>,
        call<&M::xLock, O::lock, int>,
        pass<&M::xUnlock, int>,
        pass<&M::xCheckReservedLock, int*>,
        pass<&M::xFileControl, int, void*>,
        pass<&M::xSectorSize>,
        pass<&M::xDeviceCharacteristics>,
        call<&M::xShmMap, O::shared_memory, int, int, int, void volatile**>,
        pass<&M::xShmLock, int, int, int>,
        pass<&M::xShmBarrier>,
        pass<&M::xShmUnmap, int>,
        [](sqlite3_file*, sqlite3_int64, int, void** page) {  // no memory maps: they cannot fail
          *page = nullptr;
          return SQLITE_OK;
        },
        [](sqlite3_file*, sqlite3_int64, void*) { return SQLITE_OK; }};
    return &all;
  }

  static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
    file->pMethods = nullptr;
    if (fails(DiskOperation::open)) return SQLITE_CANTOPEN;
    sqlite3_file* wrapped = reinterpret_cast<File*>(file)->wrapped();
    std::memset(wrapped, 0, static_cast<std::size_t>(real()->szOsFile));
    const int result = real()->xOpen(real(), name, wrapped, flags, out_flags);
    if (wrapped->pMethods) file->pMethods = methods();
    return result;
  }
  static int remove(sqlite3_vfs*, const char* name, int sync_directory) {
    if (fails(DiskOperation::remove)) return SQLITE_IOERR_DELETE;
    return real()->xDelete(real(), name, sync_directory);
  }

  sqlite3_vfs vfs_{};
};

}  // namespace misalign::schema
