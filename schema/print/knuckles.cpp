#include "schema/print/knuckles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/files/user_error.hpp"
#include "schema/kit/plate_ring.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

// The contour beside a crease: places of its ends on the way from the crease's first vertex.
std::array<double, 2> span_of(const solver::Sheet& sheet, int facet, const solver::Crease& crease,
                              const KitFittings& fittings) {
  const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  std::size_t side = 0;
  while (std::minmax(around[side], around[(side + 1) % 4]) != std::minmax(crease.a, crease.b)) {
    ++side;
  }
  const Vector2d from = sheet.point_mm(crease.a),
                 along = (sheet.point_mm(crease.b) - from).normalized();
  const auto ends = plate_face(sheet, facet, fittings, PlateFace::upper).side(side);
  const auto [least, most] = std::minmax({along.dot(ends[0] - from), along.dot(ends[1] - from)});
  return {least, most};
}

}  // namespace

std::vector<Knuckle> knuckles_on(const solver::Sheet& sheet, int facet, std::size_t side,
                                 const KitFittings& fittings, double clearance_mm) {
  const solver::Crease& crease =
      sheet.mechanism().creases[static_cast<std::size_t>(fittings.edges.edge(facet, side).crease)];
  const auto left = span_of(sheet, crease.left, crease, fittings),
             right = span_of(sheet, crease.right, crease, fittings);
  const double from_mm = std::max(left[0], right[0]),
               room_mm = std::min(left[1], right[1]) - from_mm;
  const int pairs = std::max(1, static_cast<int>(room_mm / (2 * kKnuckle_mm)));
  const int count = 2 * pairs + 1;
  const double length_mm = (room_mm - (count + 1) * clearance_mm) / count;
  if (length_mm < kLeastKnuckle_mm) {
    throw UserError(solver::OptionFault{
        "thickness_mm", fmt::format("{:g}", fittings.edges.thickness_mm()),
        fmt::format("too thick for knuckles on the crease {} ({:.3g} mm of it are free)",
                    solver::line_label(crease.a, crease.b), std::max(0.0, room_mm)),
        "take thinner plates, or trim less"});
  }
  const bool is_left = facet == crease.left,
             is_along =
                 sheet.base().sheet.facets[static_cast<std::size_t>(facet)][side] == crease.a;
  const double axis_mm = (sheet.point_mm(crease.b) - sheet.point_mm(crease.a)).norm();
  std::vector<Knuckle> knuckles;
  for (int k = is_left ? 0 : 1; k < count; k += 2) {
    const double begin_mm = from_mm + clearance_mm + k * (length_mm + clearance_mm),
                 end_mm = begin_mm + length_mm;
    knuckles.push_back(is_along ? Knuckle{begin_mm, end_mm}
                                : Knuckle{axis_mm - end_mm, axis_mm - begin_mm});
  }
  if (!is_along) std::ranges::reverse(knuckles);
  return knuckles;
}

}  // namespace misalign::schema
