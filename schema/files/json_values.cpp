#include "schema/files/json_values.hpp"

#include <algorithm>
#include <iterator>

namespace misalign::schema {

bool are_numbers(const Json& value, std::size_t count) {
  return value.is_array() && value.size() == count &&
         std::ranges::all_of(value, [](const Json& element) { return element.is_number(); });
}

bool is_place(const Json& value) {
  constexpr int kMostPlace = 1000;
  return value.is_number_integer() && value >= 0 && value < kMostPlace;
}

void leave_out_defaults(Json& value, const Json& defaults) {
  for (auto it = value.begin(); it != value.end();) {
    const auto at = defaults.find(it.key());
    if (at != defaults.end() && it->is_object() && at->is_object()) leave_out_defaults(*it, *at);
    const bool same = at != defaults.end() && (*it == *at || (it->is_object() && it->empty()));
    it = same ? value.erase(it) : std::next(it);
  }
}

}  // namespace misalign::schema
