// Holds tolerances for comparing a candidate's columns between machines, or between solvers.
#pragma once

#include <string>

#include "schema/catalogue/metric_table.hpp"
#include "schema/files/input.hpp"

namespace misalign::search {

struct ColumnTolerances {
  double width_mm, sample_deg;  ///< panel width, and angle between samples

  /// Returns whether two values of a column agree within the allowance in the table of metrics.
  /// Whole numbers and texts must be equal; elongations, a JSON list as text, are compared one by
  /// one.
  bool agree(const std::string& column, const schema::Json& a, const schema::Json& b) const;

 private:
  bool numbers_agree(const schema::Json& a, const schema::Json& b,
                     const schema::Allowance& allowance) const;
  bool elongations_agree(const schema::Json& a, const schema::Json& b) const;
};

}  // namespace misalign::search
