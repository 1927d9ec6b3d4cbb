// Records the ascent from a draw to the candidate of an optimising search.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace misalign::schema {

/// Reasons why an ascent ended, as in the table.
inline constexpr std::string_view kAscentEnds[] = {"no_step_is_better", "most_steps",
                                                   "breaks_a_limit", "has_no_value"};

/// A row for table `ascent`; values of the campaign's objective.
struct AscentRecord {
  std::optional<double> start_value, end_value;
  int steps = 0, sheets_folded = 0;
  std::string ended;                      ///< one of kAscentEnds
  std::optional<std::string> limited_by;  ///< JSON

  bool operator==(const AscentRecord&) const = default;
};

}  // namespace misalign::schema
