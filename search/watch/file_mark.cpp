#include "search/watch/file_mark.hpp"

#include <algorithm>
#include <ctime>

#include "schema/catalogue/writer_lock.hpp"
#include "schema/files/file_name.hpp"

namespace misalign::search {
namespace {

constexpr double kTick_s = 0.05;

}  // namespace

FileMark::Times FileMark::times_of(const struct stat& file) {
  return {file.st_dev, file.st_ino, file.st_size, file.st_mtim.tv_sec, file.st_mtim.tv_nsec};
}

FileMark FileMark::of(const std::string& path) {
  const std::string file = schema::end_of_links(path);
  FileMark mark;
  double newest_s = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    struct stat found {};
    if (::stat((file + (k == 0 ? "" : "-wal")).c_str(), &found) != 0) continue;
    if (k == 0) mark.exists_ = true;
    mark.files_[k] = times_of(found);
    newest_s = std::max(newest_s, static_cast<double>(found.st_mtim.tv_sec) +
                                      1e-9 * static_cast<double>(found.st_mtim.tv_nsec));
  }
  mark.is_written_ = mark.exists_ && schema::is_being_written(file);
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  mark.is_quiet_ = newest_s + kTick_s <
                   static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  return mark;
}

bool FileMark::is_like(const FileMark& later) const {
  return exists_ && is_quiet_ && later.exists_ && is_written_ == later.is_written_ &&
         files_ == later.files_;
}

}  // namespace misalign::search
