#include "schema/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "schema/input.hpp"

namespace misalign::schema {

void write_text_file(const std::string& path, const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    throw UserError(kExitFailure,
                    path + ": cannot be written (" + why + "); choose another --output");
  };
  std::error_code error;
  std::filesystem::path target = path;  // what a link points to is written, not the link
  if (std::filesystem::is_symlink(target, error)) {
    target = target.parent_path() / std::filesystem::read_symlink(target, error);
  }
  if (std::filesystem::exists(target, error) && !std::filesystem::is_regular_file(target, error)) {
    refuse("it is there, and no file");
  }
  const std::filesystem::path part = target.string() + ".part";
  errno = 0;
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  const std::string why = std::strerror(errno != 0 ? errno : EIO);
  if (!file) {
    std::filesystem::remove(part, error);
    refuse(why);
  }
  std::filesystem::rename(part, target, error);
  if (error) {
    const std::string message = error.message();
    std::filesystem::remove(part, error);
    refuse(message);
  }
}

}  // namespace misalign::schema
