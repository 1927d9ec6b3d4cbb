// How a candidate of an optimising search came from its draw.
#pragma once

#include <optional>
#include <string>

namespace misalign::schema {

/// A row of table `ascent` in the making; values as the campaign's goal.
struct AscentRecord {
  std::optional<double> start_value, end_value;
  int steps = 0, sheets_folded = 0;
  std::string ended;                      ///< as the table's column
  std::optional<std::string> limited_by;  ///< JSON

  bool operator==(const AscentRecord&) const = default;
};

}  // namespace misalign::schema
