// Writes a count with its noun.
#pragma once

#include <cstdint>
#include <string>

namespace misalign::search {

/// "1 draw", "2 draws".
inline std::string count_text(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace misalign::search
