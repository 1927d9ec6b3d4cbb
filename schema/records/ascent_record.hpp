// How a candidate of an optimising search came from its draw.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace misalign::schema {

/// Why one ended, as the table has it.
inline constexpr std::string_view kAscentEnds[] = {"no_step_is_better", "most_steps",
                                                   "breaks_a_limit", "has_no_value"};

/// A row of table `ascent` in the making; values as the campaign's goal.
struct AscentRecord {
  std::optional<double> start_value, end_value;
  int steps = 0, sheets_folded = 0;
  std::string ended;                      ///< one of kAscentEnds
  std::optional<std::string> limited_by;  ///< JSON

  bool operator==(const AscentRecord&) const = default;
};

}  // namespace misalign::schema
