#include "search/terminal/site.hpp"

#include <array>

namespace misalign::search {

std::optional<std::filesystem::path> place_of_site() {
  constexpr std::array kPlaces = {"../share/doc/misalign/html", "../site/html"};
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  for (const char* place : kPlaces) {
    const std::filesystem::path folder = program.parent_path() / place;
    if (std::filesystem::exists(folder / "index.html", ignored)) return folder.lexically_normal();
  }
  return {};
}

}  // namespace misalign::search
