// The numbers that people give studies, on the command line and from Python alike, beside those of
// a design.
#pragma once

#include <cstdint>
#include <string_view>

#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// Trials with play are kept until all of them are counted: 64 bytes each.
inline constexpr std::uint64_t kMostBacklashTrials = 1000000;

/// Of a study's "amplitude_mm", say, as the table has it; no study: of all.
DesignLimits parameter_limits(std::string_view study, std::string_view name);

/// UserError (bad_request) unless it lies within these.
void check_parameter(std::string_view study, std::string_view name, double value);
/// The same of a number that is a design's by another name.
void check_design(std::string_view name, std::string_view design_key, double value);

}  // namespace misalign::schema
