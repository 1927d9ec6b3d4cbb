// How much a candidate's columns may differ between machines, or between solvers.
#pragma once

#include <string>

#include "schema/files/input.hpp"

namespace misalign::search {

struct ColumnTolerances {
  double width_mm, sample_deg;  ///< of a panel, and between samples

  /// Whether two values of this column are the same for what is known of their errors. Whole
  /// numbers and texts must be equal; elongations, the text of a JSON list, agree one by one.
  bool agree(const std::string& column, const schema::Json& a, const schema::Json& b) const;
};

}  // namespace misalign::search
