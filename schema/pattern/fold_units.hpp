// Knows the units of length of FOLD.
#pragma once

#include <optional>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Returns the length of a frame_unit in mm, 1 for "unit"; none for a unit that is not known.
std::optional<double> mm_of_unit(const Json& frame_unit);

}  // namespace misalign::schema
