#include "schema/catalogue/writer_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "schema/files/input.hpp"

namespace misalign::schema {
namespace {

struct flock locked_byte() {
  struct flock byte {};
  byte.l_type = F_WRLCK;
  byte.l_whence = SEEK_SET;
  byte.l_start = 1LL << 62;
  byte.l_len = 1;
  return byte;
}

}  // namespace

WriterLock::WriterLock(const std::string& path, Missing missing)
    // O_NONBLOCK: the path may be a named pipe.
    : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0 && errno == ENOENT) {
    if (missing == Missing::refused) {
      throw UserError(
          Cause::bad_input,
          path + ": there is no such file any more; put it back, then the same command again");
    }
    descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    made_the_file_ = descriptor_ >= 0;
  }
  if (descriptor_ < 0) {
    throw UserError(Cause::failure, path + ": cannot be written (" + std::strerror(errno) +
                                        "); choose a writable place with " +
                                        parameter("catalogue"));
  }
  try {
    check_kind();
    lock();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

void WriterLock::check_kind() const {
  struct stat opened {};
  if (::fstat(descriptor_, &opened) != 0) return;  // later calls report the failure
  if (!S_ISREG(opened.st_mode)) {
    throw UserError(Cause::bad_input, path_ +
                                          ": is no catalogue (it exists, and is no file); choose " +
                                          "another place with " + parameter("catalogue"));
  }
  if (opened.st_nlink > 1) {
    throw UserError(
        Cause::failure,
        path_ + ": has " + std::to_string(opened.st_nlink) +
            " names (hard links; a journal goes by one of them, and whoever opens another would "
            "read half of a catalogue); copy it with cp, and write the copy");
  }
}

void WriterLock::lock() const {
  struct flock byte = locked_byte();
  if (::fcntl(descriptor_, F_OFD_SETLK, &byte) == 0) return;
  if (errno == EAGAIN || errno == EACCES) {
    throw UserError(Cause::in_use, path_ +
                                       ": another search is writing this catalogue; wait for it, "
                                       "or give this one a file of its own with " +
                                       parameter("catalogue"));
  }
  throw UserError(Cause::failure, path_ + ": cannot be locked (" + std::strerror(errno) +
                                      "); choose a place whose file system has locks");
}

WriterLock::~WriterLock() { ::close(descriptor_); }

void WriterLock::check_file_is_there() const {
  struct stat opened {
  }, named{};
  if (::fstat(descriptor_, &opened) == 0 && ::stat(path_.c_str(), &named) == 0 &&
      opened.st_dev == named.st_dev && opened.st_ino == named.st_ino) {
    return;
  }
  throw UserError(
      Cause::failure,
      path_ +
          ": was removed or replaced while this campaign was writing it; put it back (its last "
          "copy holds what was committed until then), and the same command goes on from there");
}

bool is_being_written(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct flock byte = locked_byte();
  const bool asked = ::fcntl(descriptor, F_OFD_GETLK, &byte) == 0;
  ::close(descriptor);
  return asked && byte.l_type != F_UNLCK;
}

}  // namespace misalign::schema
