#include "solver/fitting/driven_range.hpp"

#include <algorithm>

namespace misalign::solver {
namespace {

double most_driven_deg(const FoldingWay& way) {
  return std::min(way.end_deg(), way.over_folded_deg().value_or(180));
}

}  // namespace

double driven_from_deg(const Sheet& sheet, const FoldingWay& way,
                       const std::optional<double>& from_deg, double to_deg) {
  const double d_deg = sheet.deploys_from_deg();
  return std::min(from_deg.value_or(d_deg > to_deg ? d_deg : most_driven_deg(way)), way.end_deg());
}

std::optional<OptionFault> driven_range_fault(const Sheet& sheet, const FoldingWay& way,
                                              const std::optional<double>& from_deg,
                                              double to_deg) {
  const double typed_deg = from_deg.value_or(driven_from_deg(sheet, way, from_deg, to_deg));
  const double most_deg = most_driven_deg(way);
  if (typed_deg > most_deg + kSameAngle_deg) {
    return OptionFault{"from_deg", shown("%.10g", typed_deg),
                       sheet.name() + " folds to " + shown("%.6g", most_deg) + " deg",
                       "name that or a smaller angle"};
  }
  if (typed_deg > to_deg) return {};
  return OptionFault{"from_deg", shown("%.10g", typed_deg),
                     "springs are chosen down to " + shown("%.6g", to_deg) + " deg",
                     "name a larger angle"};
}

}  // namespace misalign::solver
