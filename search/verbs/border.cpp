#include "search/verbs/border.hpp"

#include <algorithm>
#include <array>

namespace misalign::search {

// Options have the names of parameters without their units; these two keep it, as another option,
// or word, has the bare name.
std::string option_of(std::string_view parameter, bool has_value) {
  constexpr std::array<std::string_view, 2> kWithUnit = {"rest_deg", "dash_mm"};
  std::string option(parameter);
  if (std::find(kWithUnit.begin(), kWithUnit.end(), parameter) == kWithUnit.end()) {
    for (const std::string_view unit : {"_n_per_mm", "_deg", "_mm", "_n"}) {
      if (option.ends_with(unit)) option.resize(option.size() - unit.size());
    }
  }
  std::replace(option.begin(), option.end(), '_', '-');
  return "--" + option + (has_value ? " " : "");
}

}  // namespace misalign::search
