// Bounds the parameters of studies, on the command line and in Python alike, beside those of a
// design.
#pragma once

#include <cstdint>
#include <string_view>

#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// Largest number of trials with play, which are kept until all are counted: 64 bytes each.
inline constexpr std::uint64_t kMostBacklashTrials = 1000000;

/// Returns the bounds of a study's parameter, such as "amplitude_mm", by the table; an empty study:
/// of all studies.
DesignLimits parameter_limits(std::string_view study, std::string_view name);

/// Throws a UserError (bad_request) unless a parameter lies within its bounds.
void check_parameter(std::string_view study, std::string_view name, double value);
/// Does the same for a number of a design under another name.
void check_design(std::string_view name, std::string_view design_key, double value);

}  // namespace misalign::schema
