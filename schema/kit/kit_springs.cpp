#include "schema/kit/kit_springs.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "solver/studies/angle_of_use.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The place of a spring's end in a folded shape: by the panel's two edges at one vertex, and its
// height off the panel.
Vector3d folded_point(const solver::Sheet& sheet, const SpringEnd& end,
                      const Eigen::Matrix3Xd& shape) {
  const auto& v = sheet.base().sheet.facets[static_cast<std::size_t>(end.facet)];
  const auto k = static_cast<std::size_t>(solver::corner_of(v, end.vertex));
  const int next = v[(k + 1) % 4], before = v[(k + 3) % 4];
  const Vector2d at_mm = sheet.point_mm(end.vertex);
  Eigen::Matrix2d edges;
  edges << sheet.point_mm(next) - at_mm, sheet.point_mm(before) - at_mm;
  const Vector2d share = edges.inverse() * (end.at_mm - at_mm);
  const Vector3d folded = shape.col(end.vertex), after = shape.col(next) - folded,
                 along = shape.col(before) - folded;
  return folded + share.x() * after + share.y() * along +
         end.height_mm * after.cross(along).normalized();
}

LengthTrend trend_of(const std::vector<double>& length_mm, double band_mm) {
  double least = length_mm[0], most = length_mm[0], fallen = 0, risen = 0;
  for (const double length : length_mm) {  // largest fall and rise so far
    least = std::min(least, length);
    most = std::max(most, length);
    fallen = std::max(fallen, most - length);
    risen = std::max(risen, length - least);
  }
  if (fallen > band_mm && risen > band_mm) return LengthTrend::reverses;
  if (fallen > band_mm) return LengthTrend::shortens;
  return risen > band_mm ? LengthTrend::lengthens : LengthTrend::constant;
}

}  // namespace

const char* word_of(LengthTrend trend) {
  constexpr const char* kWords[] = {"constant", "lengthens", "shortens", "reverses"};
  return kWords[static_cast<std::size_t>(trend)];
}

double KitSpring::stroke_mm() const {
  const auto [least, most] = std::minmax_element(length_mm.begin(), length_mm.end());
  return *most - *least;
}

Eigen::Index kit_rows(const solver::Sheet& sheet, const std::optional<double>& from_deg) {
  return sheet.deploys_from_deg() > 0 ? solver::rows_of_use(sheet, from_deg) : sheet.rows_shown();
}

std::vector<KitSpring> kit_springs(const solver::Sheet& sheet, const KitFittings& fittings,
                                   Eigen::Index rows) {
  const double band_mm = solver::kInactiveBand_widths * sheet.mechanism().panel_width_mm;
  std::vector<KitSpring> springs;
  for (std::size_t e = 0; e < fittings.ends.size(); e += 2) {
    const SpringEnd &from = fittings.ends[e], &to = fittings.ends[e + 1];
    KitSpring spring{from, to, {(from.at_mm - to.at_mm).norm()}, {sheet.history().flat_mm[e / 2]},
                     {},   {}};
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
      const Eigen::Matrix3Xd& shape = sheet.shapes_mm()[row];
      spring.length_mm.push_back(
          (folded_point(sheet, from, shape) - folded_point(sheet, to, shape)).norm());
      spring.diagonal_mm.push_back(sheet.history().length_mm(row, e / 2));
    }
    spring.trend = trend_of(spring.length_mm, band_mm);
    spring.diagonal_trend = trend_of(spring.diagonal_mm, band_mm);
    springs.push_back(std::move(spring));
  }
  return springs;
}

std::string contradiction_of(const std::vector<KitSpring>& springs) {
  int reverse = 0, driven = 0, idle = 0, opposite = 0;
  for (const KitSpring& spring : springs) {
    if (!spring.contradicts_verdict()) continue;
    ++(spring.diagonal_trend == LengthTrend::constant ? driven
       : spring.trend == LengthTrend::reverses        ? reverse
       : spring.trend == LengthTrend::constant        ? idle
                                                      : opposite);
  }
  std::vector<std::string> kinds;
  const auto add = [&](int count, const char* singular, const char* plural) {
    if (count > 0) kinds.push_back(fmt::format("{} {}", count, count == 1 ? singular : plural));
  };
  add(opposite, "opposes its diagonal", "oppose their diagonals");
  add(reverse, "reverses", "reverse");
  add(idle, "keeps its length", "keep their lengths");
  add(driven, "changes its length though its diagonal does not",
      "change their lengths though their diagonals do not");
  if (kinds.empty()) return "";
  return fmt::format(
      "{} of {} springs contradict the verdict ({}); --spring-at vertex attaches them where it "
      "holds",
      opposite + reverse + idle + driven, springs.size(), fmt::join(kinds, ", "));
}

}  // namespace misalign::schema
