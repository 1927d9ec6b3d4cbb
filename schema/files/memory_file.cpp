#include "schema/files/memory_file.hpp"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "schema/files/file_bytes.hpp"
#include "schema/files/input.hpp"

namespace misalign::schema {

MemoryFile::MemoryFile(const std::string& name)
    : name_(name), descriptor_(::memfd_create("misalign", MFD_CLOEXEC)) {
  if (descriptor_ < 0) refuse(errno);
}

MemoryFile::~MemoryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

std::string MemoryFile::bytes() const {
  struct stat found {};
  if (::fstat(descriptor_, &found) != 0) refuse(errno);
  std::string bytes(static_cast<std::size_t>(found.st_size), '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = uninterrupted([&] {
      return ::pread(descriptor_, bytes.data() + done, bytes.size() - done,
                     static_cast<off_t>(done));
    });
    if (count <= 0) refuse(count < 0 ? errno : EIO);
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

void MemoryFile::refuse(int error) const {
  throw UserError(Cause::failure, name_ + ": cannot be made in memory (" + std::strerror(error) +
                                      "); see to the system");
}

}  // namespace misalign::schema
