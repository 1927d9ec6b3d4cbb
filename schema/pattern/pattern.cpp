#include "schema/pattern/pattern.hpp"

#include <algorithm>

namespace misalign::schema {

Json facet_json(const Pattern& pattern, int facet) { return pattern.base.sheet.places[facet]; }

int facet_of_json(const Pattern& pattern, const Json& place) {
  const auto& places = pattern.base.sheet.places;
  const auto at =
      std::ranges::find_if(places, [&](const auto& other) { return place == Json(other); });
  return at == places.end() ? -1 : static_cast<int>(at - places.begin());
}

}  // namespace misalign::schema
