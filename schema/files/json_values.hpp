// Writes values as JSON that may be absent or not finite.
#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "schema/files/input.hpp"

namespace misalign::schema {

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

/// Returns null for infinities and NaN, which JSON does not have.
inline Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// Returns a list of `projection`, a function or a member, of each element.
template <class Range, class Of>
Json json_list(const Range& range, const Of& projection) {
  Json list = Json::array();
  for (const auto& element : range) list.push_back(std::invoke(projection, element));
  return list;
}

/// Returns whether a value is a list of `count` numbers.
bool are_numbers(const Json& value, std::size_t count);

/// Removes all values from an object that equal their `defaults`, also within its objects.
void leave_out_defaults(Json& value, const Json& defaults);

}  // namespace misalign::schema
