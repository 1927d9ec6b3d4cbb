#include "schema/files/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "schema/files/kept_inputs.hpp"
#include "schema/files/printable.hpp"
#include "schema/files/user_error.hpp"

namespace misalign::schema {
namespace {

bool has_zero_byte(const std::string& path) { return path.find('\0') != std::string::npos; }

/// An open file, and its error sentences.
class OpenFile {
 public:
  OpenFile(const std::string& path, int flags)
      : path_(path),
        // A name from a file may hold a zero byte, which ends a name for the system.
        descriptor_(has_zero_byte(path) ? -1 : uninterrupted([&] {
          return ::open(path.c_str(), flags | O_CLOEXEC);
        })),
        error_(is_open() || has_zero_byte(path) ? 0 : errno) {}
  ~OpenFile() {
    if (is_open()) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  struct stat status() const {
    struct stat found {};
    ::fstat(descriptor_, &found);
    return found;
  }
  // The disk's failure is not the file's fault, and the reader is not sent to look for it
  // elsewhere.
  [[noreturn]] void refuse_unopened() const {
    constexpr int kOfThePath[] = {0,     ENOENT, EACCES,       EPERM, ENOTDIR,
                                  ELOOP, EISDIR, ENAMETOOLONG, ENXIO};
    const bool is_disk = std::ranges::find(kOfThePath, error_) == std::end(kOfThePath);
    const std::string why = is_disk ? std::strerror(error_) : "no such file, or no permission";
    throw UserError(is_disk ? Cause::failure : Cause::bad_input,
                    printable(path_) + ": cannot be opened (" + why + "); " +
                        (is_disk ? "see to the system, then the same again" : "check the path"));
  }
  void skip_to(off_t place) const { ::lseek(descriptor_, place, SEEK_SET); }
  // Reads the next bytes, none at the end.
  std::string part(std::size_t most_bytes) const {
    std::string bytes(most_bytes, '\0');
    const ssize_t count =
        uninterrupted([&] { return ::read(descriptor_, bytes.data(), bytes.size()); });
    if (count < 0) {
      const bool is_directory = errno == EISDIR;
      throw UserError(is_directory ? Cause::bad_input : Cause::failure,
                      printable(path_) + ": cannot be read (" + std::strerror(errno) + "); " +
                          (is_directory ? "check the path" : "see to the disk"));
    }
    bytes.resize(static_cast<std::size_t>(count));
    return bytes;
  }

 private:
  const std::string path_;
  const int descriptor_;
  const int error_;  // of opening it
};

}  // namespace

std::string read_file(const std::string& path, std::size_t most_bytes, FileKind kind) {
  // A pipe named by a file must not block.
  const OpenFile file(path, O_RDONLY | (kind == FileKind::regular ? O_NONBLOCK : 0));
  const auto refuse = [&](const std::string& why) {
    throw UserError(Cause::bad_input, printable(path) + ": " + why + "; check the path");
  };
  if (!file.is_open()) file.refuse_unopened();
  if (kind == FileKind::regular && !S_ISREG(file.status().st_mode)) {
    refuse("is no regular file (and nothing else is read because a file names it)");
  }
  note_input(file.status());
  constexpr std::size_t kPart_bytes = 1 << 16;
  std::string text;
  for (std::string part = file.part(kPart_bytes); !part.empty(); part = file.part(kPart_bytes)) {
    text += part;
    if (text.size() > most_bytes) {
      refuse("is larger than " + std::to_string(most_bytes >> 20) +
             " MB, the largest size that is read");
    }
  }
  return text;
}

std::string end_of_file(const std::string& path, std::size_t bytes) {
  const OpenFile file(path, O_RDONLY | O_NONBLOCK);
  if (!file.is_open()) return "";
  file.skip_to(std::max<off_t>(0, file.status().st_size - static_cast<off_t>(bytes)));
  return file.part(bytes);
}

}  // namespace misalign::schema
