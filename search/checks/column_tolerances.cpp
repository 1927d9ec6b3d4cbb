#include "search/checks/column_tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::search {
namespace {

using schema::Json;

struct Allowance {
  double absolute, relative;

  bool allows(double a, double b) const {
    return std::abs(a - b) <= absolute + relative * std::abs(b);
  }
};

// Where two solvers that share no arithmetic (lanes, and dense matrices) differed by w at most on
// 1,008 candidates, the limit is about 10 w.
Allowance allowance_of(const std::string& column, double width_mm, double sample_deg) {
  const auto is_ratio = column.starts_with("elongation") || column.starts_with("stroke");
  if (is_ratio) return {3e-11, 0};                         // w = 3e-12
  if (column == "deploys_from_deg") return {0, 1e-15};     // a product of two exact numbers
  if (column == "fold_limit_deg") return {1e-6, 0};        // located to 1e-7
  if (column == "stretch_sq_mm2") return {0, 2e-9};        // w = 1.4e-10
  if (column == "singular_value_min") return {0, 1e-5};    // its iteration ends at changes of 1e-6
  if (column == "residual_max") return {1e-12, 0};         // rounding, up to the closure tolerance
  if (column == "kawasaki_defect_deg") return {1e-11, 0};  // a sum of two angles, each to 1e-13
  const double slope = 1e-12 * width_mm / sample_deg;      // w = 8e-14 widths a degree
  if (column == "slope_min_mm_per_deg") return {slope, 0};
  // Rates of change, from the tangent: its error is the closure's over the singular value, 1e-12 /
  // 1e-4 radians a radian; where a bump begins is known by the root of it.
  if (column == "slope_between_min_mm_per_deg") return {1e-8 * width_mm / 57, 0};
  if (column == "bump_deg") return {1e-3, 0};
  // w = 1.7e-13 widths, states and factors dense against stored; no share of it: a small margin is
  // a small difference of lengths. 1,029 candidates of other draws than above: 195 of miura-6x6,
  // 334 of ring-6x6, 500 of miura-4x4.
  if (column == "miscut_margin_mm") return {2e-12 * width_mm, 0};
  const double isometry = 2e-11 * width_mm;  // rounding: w = 1.6e-12 widths
  if (column == "isometry_error_mm") return {isometry, 0};
  return {0, 1e-9};
}

// Elongations are stored to nine decimals.
constexpr Allowance kElongations{0.5e-9 + 3e-11, 0};

bool numbers_agree(const Json& a, const Json& b, const Allowance& allowance) {
  if (!a.is_number() || !b.is_number() || b.is_number_integer()) return a == b;
  return allowance.allows(a.get<double>(), b.get<double>());
}

bool lists_agree(const Json& a, const Json& b) {
  return a.is_array() && b.is_array() && a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [](const Json& x, const Json& y) { return numbers_agree(x, y, kElongations); });
}

}  // namespace

bool ColumnTolerances::agree(const std::string& column, const Json& a, const Json& b) const {
  if (column == "elongation") return lists_agree(schema::json_of(a), schema::json_of(b));
  return numbers_agree(a, b, allowance_of(column, width_mm, sample_deg));
}

}  // namespace misalign::search
