#include "schema/records/level_count.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace misalign::schema {
namespace {

Json counts_of(const LevelCount& level) {
  return {{"particles", level.particles},
          {"survivors", level.survivors},
          {"ancestors", level.ancestors},
          {"tried", level.tried},
          {"taken", level.taken},
          {"undecided", level.undecided},
          {"met", level.met}};
}

}  // namespace

void each_difference(
    const std::vector<LevelCount>& a, const std::vector<LevelCount>& b,
    const std::function<void(const std::string& count, const Json& a, const Json& b)>& see) {
  for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k) {
    const Json of_a = k < a.size() ? counts_of(a[k]) : Json();
    const Json of_b = k < b.size() ? counts_of(b[k]) : Json();
    for (const auto& [name, ignored] : (of_a.is_null() ? of_b : of_a).items()) {
      const Json in_a = of_a.is_null() ? Json() : of_a[name];
      const Json in_b = of_b.is_null() ? Json() : of_b[name];
      if (in_a != in_b) see(fmt::format("level {}, {}", k, name), in_a, in_b);
    }
  }
}

double share_reaching(std::uint32_t level, const std::vector<LevelCount>& levels) {
  double share = 1;
  for (std::uint32_t k = 0; k < level; ++k) {
    if (k >= levels.size()) return 0;
    share *= static_cast<double>(levels[k].survivors) / levels[k].particles;
  }
  return share;
}

}  // namespace misalign::schema
