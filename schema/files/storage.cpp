#include "schema/files/storage.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/vfs.h>

#include <filesystem>

#include "schema/files/file_name.hpp"

namespace misalign::schema {
namespace {

struct KnownType {
  std::uint64_t type;
  const char* name;
  Storage storage;
};

// Types of linux/magic.h and the file systems' sources. FUSE may be anything, also sshfs and
// Gluster.
constexpr KnownType kKnownTypes[] = {
    {0x6969, "nfs", Storage::network},        {0xFF534D42, "cifs", Storage::network},
    {0xFE534D42, "smb2", Storage::network},   {0x517B, "smb", Storage::network},
    {0x0BD00BD0, "lustre", Storage::network}, {0x47504653, "gpfs", Storage::network},
    {0x19830326, "beegfs", Storage::network}, {0x00C36400, "ceph", Storage::network},
    {0x5346414F, "afs", Storage::network},    {0x73757245, "coda", Storage::network},
    {0x01021997, "9p", Storage::network},     {0x65735546, "fuse", Storage::network},
    {0x7461636F, "ocfs2", Storage::network},  {0xAAD7AAEA, "panfs", Storage::network},
    {0x01161970, "gfs2", Storage::network},   {0x20030528, "orangefs", Storage::network},
    {0x786F4256, "vboxsf", Storage::network}, {0xEF53, "ext4", Storage::local},
    {0x58465342, "xfs", Storage::local},      {0x9123683E, "btrfs", Storage::local},
    {0x01021994, "tmpfs", Storage::local},    {0x794C7630, "overlay", Storage::local},
    {0x2FC12FC1, "zfs", Storage::local},      {0xF2F52010, "f2fs", Storage::local}};

}  // namespace

FileSystem file_system_of_type(std::uint64_t type) {
  for (const KnownType& known : kKnownTypes) {
    if (known.type == type) return {known.name, known.storage, 0};
  }
  return {fmt::format("{:#x}", type), Storage::local, 0};
}

FileSystem file_system_of(const std::string& path) {
  const std::filesystem::path directory = std::filesystem::absolute(path).parent_path();
  struct statfs found {};
  if (statfs(directory.c_str(), &found) != 0) return {"unknown", Storage::local, 0};
  // f_type may carry the highest bit of some magic numbers into its sign.
  FileSystem system = file_system_of_type(static_cast<std::uint32_t>(found.f_type));
  system.free_bytes =
      static_cast<std::uint64_t>(found.f_bavail) * static_cast<std::uint64_t>(found.f_bsize);
  return system;
}

UserError storage_failure(const std::string& written, const SQLite::Exception& error) {
  // A catalogue keeps its commits; an output without its final name is removed.
  const std::string path = output_of(written);
  const bool is_kept = path == written;
  const std::string kept = is_kept ? "; what was committed is good: " : "; nothing was written: ";
  const std::string again =
      is_kept ? ", then the same command goes on from there" : ", then give the same command again";
  // The extended code tells reading from writing, locking and so forth.
  const std::string number = error.getErrorCode() == SQLITE_IOERR
                                 ? ", " + std::to_string(error.getExtendedErrorCode())
                                 : "";
  const std::string what = " (" + printable(utf8(error.what())) + number + ")";
  switch (error.getErrorCode()) {
    case SQLITE_FULL:
      return {Cause::failure, path + ": the disk is full, or a quota is used up" + what + kept +
                                  "make room" + again};
    case SQLITE_IOERR:
      if (error.getExtendedErrorCode() == SQLITE_IOERR_SHMSIZE) {
        return {Cause::failure, path + ": no room for the index of its log" + what + kept +
                                    "make room on the disk" + again};
      }
      return {Cause::failure, path + ": reading or writing failed" + what + kept +
                                  "see to the disk and to limits of a file's size (ulimit -f)" +
                                  again};
    case SQLITE_NOMEM:
      return {Cause::failure, path + ": memory has run out" + what + kept +
                                  "request less at once, or give it more"};
    case SQLITE_READONLY:
      if (error.getExtendedErrorCode() == SQLITE_READONLY_ROLLBACK) {
        return {Cause::failure, path +
                                    ": a program that was killed has left a journal to roll back, "
                                    "which a reader may not do" +
                                    what + kept + "misalign status " + printable(path) + " " +
                                    parameter("recover") + " does it"};
      }
      [[fallthrough]];
    case SQLITE_PERM:
      return {Cause::failure, path + ": cannot be written" + what + kept +
                                  "make file and directory writable" + again};
    case SQLITE_CANTOPEN:
      return {Cause::failure, path + ": it, or a journal beside it, cannot be opened" + what +
                                  kept + "see to the directory and its permissions" + again};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PROTOCOL:  // another program stands still where it changes the log's index
      return {Cause::in_use,
              path + ": another program keeps it locked" + what + "; wait for that one to end"};
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return {Cause::bad_input, path + ": is damaged" + what +
                                    "; put a backup in its place, or save with the sqlite3 shell's "
                                    ".recover what can be saved"};
    case SQLITE_ERROR:  // the program's statements fit every valid catalogue
      return {Cause::bad_input, path + ": does not hold what a catalogue must" + what +
                                    "; put a backup in its place"};
    case SQLITE_CONSTRAINT:  // nor do they violate its own constraints
      return {Cause::bad_input,
              path + ": holds rows that contradict what is to be written" + what +
                  "; see what `misalign verify` says, or put a backup in its place"};
    default:
      return {Cause::failure, path + ": the database failed" + what + kept +
                                  "if it happens again, " +
                                  "`misalign verify` says what the file holds"};
  }
}

}  // namespace misalign::schema
