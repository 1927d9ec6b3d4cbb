// Values that may be absent, or no numbers, as JSON.
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

/// Null for infinities and NaN, which JSON does not have.
inline Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// A list of what `of`, a function or a member, is of each.
template <class Range, class Of>
Json json_list(const Range& range, const Of& of) {
  Json list = Json::array();
  for (const auto& one : range) list.push_back(std::invoke(of, one));
  return list;
}

/// True for a list of `count` numbers.
bool are_numbers(const Json& value, std::size_t count);

/// Removes from an object whatever `defaults` says just the same, in its objects, too.
void leave_out_defaults(Json& value, const Json& defaults);

}  // namespace misalign::schema
