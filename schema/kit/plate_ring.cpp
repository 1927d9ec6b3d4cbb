#include "schema/kit/plate_ring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "schema/kit/chords.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

// A corner of a plate: unit vectors along the side before it and after it, both away from it.
class Corner {
 public:
  Corner(const solver::Sheet& sheet, const std::array<int, 4>& around, std::size_t k)
      : at_mm_(sheet.point_mm(around[k])),
        before_((sheet.point_mm(around[(k + 3) % 4]) - at_mm_).normalized()),
        after_((sheet.point_mm(around[(k + 1) % 4]) - at_mm_).normalized()) {}

  bool is_convex() const { return cross(after_, before_) > 0; }

  // The corner between sides set back, cut off where it is nearer than the trim.
  PlanePoints trimmed(double before_mm, double after_mm, double trim_mm) const {
    const Vector2d mitre =
        at_mm_ + (after_mm * before_ + before_mm * after_) / cross(after_, before_);
    const Vector2d bisector = (before_ + after_).normalized();
    const double along_mm =
        std::max(0.0, trim_mm - bisector.dot(mitre - at_mm_)) / bisector.dot(after_);
    return {mitre + along_mm * before_, mitre + along_mm * after_};
  }

  // Round a disc, from the side before to the side after: its sides end where those of the contour
  // meet the disc.
  PlanePoints round_disc(double radius_mm, double before_mm, double after_mm,
                         double contour_before_mm, double contour_after_mm) const {
    const Vector2d in_before(before_.y(), -before_.x()), in_after(-after_.y(), after_.x());
    const auto end = [&](const Vector2d& along, const Vector2d& inwards, double on_disc_mm,
                         double back_mm) {
      return Vector2d(at_mm_ + std::sqrt(radius_mm * radius_mm - on_disc_mm * on_disc_mm) * along +
                      back_mm * inwards);
    };
    const Vector2d first = end(before_, in_before, contour_before_mm, contour_before_mm) - at_mm_,
                   last = end(after_, in_after, contour_after_mm, contour_after_mm) - at_mm_;
    const double turn_rad = 2 * std::numbers::pi - std::atan2(cross(last, first), last.dot(first));
    PlanePoints points = {end(before_, in_before, contour_before_mm, before_mm)};
    const PlanePoints arc =
        arc_points(at_mm_, radius_mm, std::atan2(first.y(), first.x()), turn_rad);
    points.insert(points.end(), arc.begin(), arc.end());
    points.push_back(end(after_, in_after, contour_after_mm, after_mm));
    return points;
  }

 private:
  const Vector2d at_mm_, before_, after_;
};

PlateRing ring_or_throw(const solver::Sheet& sheet, int facet, const KitFittings& fittings,
                        const std::array<double, 4>& back_mm) {
  auto ring = plate_ring(sheet, facet, fittings, back_mm);
  if (ring) return *std::move(ring);
  throw UserError(solver::OptionFault{
      "thickness_mm", fmt::format("{:g}", fittings.edges.thickness_mm()),
      fmt::format("too thick (hinges, trims and tabs leave nothing of a side of panel {})",
                  panel_label(sheet, facet)),
      "take thinner plates, a smaller angle of use, or trim less"});
}

}  // namespace

std::optional<PlateRing> plate_ring(const solver::Sheet& sheet, int facet,
                                    const KitFittings& fittings,
                                    const std::array<double, 4>& back_mm) {
  const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  const PlateEdges& edges = fittings.edges;
  PlateRing ring;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t before = (k + 3) % 4;
    const Corner corner(sheet, around, k);
    if (!corner.is_convex()) return std::nullopt;
    const SpringTab* tab = fittings.tab_at(around[k]);
    const PlanePoints points =
        tab != nullptr && tab->facet == facet
            ? corner.round_disc(tab->radius_mm, back_mm[before], back_mm[k],
                                edges.edge(facet, before).back_mm, edges.edge(facet, k).back_mm)
            : corner.trimmed(back_mm[before], back_mm[k],
                             std::max(edges.trim_mm(facet, k), tab == nullptr ? 0 : tab->clear_mm));
    ring.points.insert(ring.points.end(), points.begin(), points.end());
    ring.begins[k] = ring.points.size() - 1;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector2d along = sheet.point_mm(around[(k + 1) % 4]) - sheet.point_mm(around[k]);
    const auto [begin, end] = ring.side(k);
    if ((end - begin).dot(along) <= 0) return std::nullopt;
  }
  return ring;
}

PlateRing plate_face(const solver::Sheet& sheet, int facet, const KitFittings& fittings,
                     PlateFace face) {
  std::array<double, 4> back_mm = fittings.edges.back_mm(facet);
  for (std::size_t k = 0; k < 4; ++k) {
    const PlateEdge& edge = fittings.edges.edge(facet, k);
    if (edge.valley == (face == PlateFace::upper)) back_mm[k] += edge.bevel_mm;
  }
  return ring_or_throw(sheet, facet, fittings, back_mm);
}

PlanePoints plate_contour(const solver::Sheet& sheet, int facet, const KitFittings& fittings) {
  constexpr double kSame_mm = 1e-9;
  PlanePoints ring = ring_or_throw(sheet, facet, fittings, fittings.edges.back_mm(facet)).points;
  const auto same = [](const Vector2d& a, const Vector2d& b) { return (a - b).norm() < kSame_mm; };
  ring.erase(std::unique(ring.begin(), ring.end(), same), ring.end());
  if (same(ring.front(), ring.back())) ring.pop_back();
  return ring;
}

}  // namespace misalign::schema
