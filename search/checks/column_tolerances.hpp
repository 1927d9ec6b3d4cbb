// Tolerances for comparing a candidate's columns between machines, or between solvers.
#pragma once

#include <string>

#include "schema/catalogue/metric_table.hpp"
#include "schema/files/input.hpp"

namespace misalign::search {

struct ColumnTolerances {
  double width_mm, sample_deg;  ///< of a panel, and between samples

  /// Whether two values of this column are the same for what is known of their errors, which the
  /// table of metrics says. Whole numbers and texts must be equal; elongations, the text of a JSON
  /// list, agree one by one.
  bool agree(const std::string& column, const schema::Json& a, const schema::Json& b) const;

 private:
  bool numbers_agree(const schema::Json& a, const schema::Json& b,
                     const schema::Allowance& allowance) const;
  bool elongations_agree(const schema::Json& a, const schema::Json& b) const;
};

}  // namespace misalign::search
