#include "search/checks/column_tolerances.hpp"

#include <algorithm>

namespace misalign::search {
namespace {

using schema::Json;

// Elongations are stored to nine decimals.
constexpr schema::Allowance kElongations{.absolute = 0.5e-9 + 3e-11};

}  // namespace

bool ColumnTolerances::numbers_agree(const Json& a, const Json& b,
                                     const schema::Allowance& allowance) const {
  if (!a.is_number() || !b.is_number() || b.is_number_integer()) return a == b;
  return allowance.allows(a.get<double>(), b.get<double>(), width_mm, sample_deg);
}

bool ColumnTolerances::elongations_agree(const Json& a, const Json& b) const {
  return a.is_array() && b.is_array() && a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [&](const Json& x, const Json& y) {
           return numbers_agree(x, y, kElongations);
         });
}

bool ColumnTolerances::agree(const std::string& column, const Json& a, const Json& b) const {
  if (column == "elongation") return elongations_agree(schema::json_of(a), schema::json_of(b));
  if (column == "first_fault" && a.is_string() && b.is_string()) {
    return solver::may_be_one_fault(a.get_ref<const std::string&>(),
                                    b.get_ref<const std::string&>());
  }
  const schema::MetricEntry* metric = schema::find_metric(column);
  return metric ? numbers_agree(a, b, metric->allowance) : a == b;
}

}  // namespace misalign::search
