#include "schema/files/kept_inputs.hpp"

#include <mutex>
#include <set>
#include <utility>

namespace misalign::schema {
namespace {

struct KeptInputs {
  std::mutex mutex;
  bool is_on = false;
  std::set<std::pair<dev_t, ino_t>> files;
};

KeptInputs& kept_inputs() {
  static KeptInputs kept;
  return kept;
}

}  // namespace

void keep_inputs() {
  const std::lock_guard lock(kept_inputs().mutex);
  kept_inputs().is_on = true;
}

void note_input(const struct stat& file) {
  const std::lock_guard lock(kept_inputs().mutex);
  if (kept_inputs().is_on && S_ISREG(file.st_mode)) {
    kept_inputs().files.emplace(file.st_dev, file.st_ino);
  }
}

bool is_input(const struct stat& file) {
  const std::lock_guard lock(kept_inputs().mutex);
  return kept_inputs().files.contains({file.st_dev, file.st_ino});
}

}  // namespace misalign::schema
