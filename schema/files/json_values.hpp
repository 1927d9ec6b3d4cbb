// Values that may be absent, or no numbers, as JSON.
#pragma once

#include <cmath>
#include <optional>

#include "schema/files/input.hpp"

namespace misalign::schema {

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

/// Null for infinities and NaN, which JSON does not have.
inline Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace misalign::schema
