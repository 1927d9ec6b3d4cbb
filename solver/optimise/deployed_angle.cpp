#include "solver/optimise/deployed_angle.hpp"

#include <algorithm>
#include <cassert>
#include <optional>

namespace misalign::solver {
namespace {

// The angle at which a crease is folded to 180 degrees is solved this close around the way's, which
// is inexact by thousandths of a degree between stations, and no closer to a limit.
constexpr double kAroundFlat_deg = 0.1, kFromLimit_deg = 1e-6;

// The angle at which a crease is folded to 180 degrees; none where no crease is.
std::optional<double> folded_flat_deg(const Sheet& sheet) {
  const auto is_beyond = [&](double angle_deg) {
    const Sheet::Pose& pose = sheet.at(angle_deg);
    return pose.is_closed && pose.fold_deg.cwiseAbs().maxCoeff() > 180 + kOverFoldBand_deg;
  };
  const FoldingWay& way = *sheet.way();
  const auto about_deg = way.over_folded_deg();
  if (!about_deg) return {};
  double before_deg = *about_deg - kAroundFlat_deg,
         beyond_deg = std::min(*about_deg + kAroundFlat_deg, way.end_deg() - kFromLimit_deg);
  // A crease that only touches 180 degrees, in a sharp bend, gives no angle to solve for.
  if (is_beyond(before_deg) || !is_beyond(beyond_deg)) return about_deg;
  while (beyond_deg - before_deg > kFromLimit_deg) {
    const double middle_deg = (before_deg + beyond_deg) / 2;
    assert(before_deg < middle_deg && middle_deg < beyond_deg);
    (is_beyond(middle_deg) ? beyond_deg : before_deg) = middle_deg;
  }
  return before_deg;
}

}  // namespace

double goes_until_deg(const Sheet& sheet) {
  assert(sheet.way());
  const auto& reverses_deg = sheet.record().extremes.reverses_deg;
  return std::min(
      {sheet.way()->end_deg(), reverses_deg.value_or(180), folded_flat_deg(sheet).value_or(180)});
}

}  // namespace misalign::solver
