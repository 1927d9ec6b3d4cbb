// Writes values as JSON that may be absent or not finite.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
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
/// Returns whether a value can be a row or column of a sheet; the sheet knows which exist.
bool is_place(const Json& value);

/// Returns the row of a table whose `name` a key holds; null if the key is absent, or, with a
/// fault, if no row has it.
template <class Row, std::size_t kCount>
const Row* read_name(ObjectReader& reader, const char* key, const Row (&rows)[kCount],
                     const char* why, const char* suggestion) {
  const Json* const value = reader.find(key);
  if (!value) return nullptr;
  const auto is_its = [&](const Row& row) { return *value == row.name; };
  const Row* const at = std::ranges::find_if(rows, is_its);
  if (at != std::end(rows)) return at;
  reader.faults().add(reader.shown(key), why, suggestion);
  return nullptr;
}

/// Removes all values from an object that equal their `defaults`, also within its objects.
void leave_out_defaults(Json& value, const Json& defaults);

}  // namespace misalign::schema
