#include "schema/kit/panel_room.hpp"

#include <algorithm>
#include <cmath>

#include "schema/kit/kit_outline.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

// Width of a letter of the stroke font, in heights of a capital: a bound.
constexpr double kLetter = 0.95;
constexpr double kClear_mm = 1;  // least distance between words, and from edges and bores

}  // namespace

PanelRoom::PanelRoom(const solver::Sheet& sheet, int facet, const KitFittings& fittings) {
  const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  Ring corners;
  for (const int v : around) {
    corners.push_back(sheet.point_mm(v));
    if (const SpringTab* tab = fittings.tab_at(v)) {
      fittings_.push_back({sheet.point_mm(v), tab->clear_mm});
    }
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d along = (corners[(k + 1) % 4] - corners[k]).normalized(),
                   inwards(-along.y(), along.x());
    sides_.push_back({corners[k] + fittings.edges.edge(facet, k).back_mm * inwards, inwards});
    const double trim_mm = fittings.edges.trim_mm(facet, k);
    if (trim_mm == 0) continue;
    const Vector2d bisector = PanelCorner(sheet, facet, around[k]).bisector;
    sides_.push_back({corners[k] + trim_mm * bisector, bisector});
  }
  middle_mm_ = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  size_mm_ = std::sqrt(signed_area_mm2(corners));
  for (const Bore& bore : fittings.bores) {
    if (bore.facet == facet) fittings_.push_back({bore.centre_mm, 0.5 * bore.diameter_mm});
  }
}

bool PanelRoom::has_room_for(const Box& box) const {
  for (const Side& side : sides_) {
    // The depth of the box's farthest corner.
    const double depth =
        side.inwards.dot(box.middle - side.at_mm) - side.inwards.cwiseAbs().dot(box.half);
    if (depth < kClear_mm) return false;
  }
  for (const DrawnCircle& fitting : fittings_) {
    const Vector2d off = (fitting.centre_mm - box.middle).cwiseAbs() - box.half;
    if (off.cwiseMax(0).norm() < fitting.radius_mm + kClear_mm) return false;
  }
  return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) {
    const Vector2d apart = (other.middle - box.middle).cwiseAbs() - other.half - box.half;
    return apart.maxCoeff() < kClear_mm;
  });
}

std::optional<DrawnText> PanelRoom::place(const std::string& words, double height_mm,
                                          const std::vector<Vector2d>& middles_mm) {
  const Vector2d half = 0.5 * height_mm * Vector2d(kLetter * static_cast<double>(words.size()), 1);
  for (const Vector2d& middle : middles_mm) {
    if (!has_room_for({middle, half})) continue;
    taken_.push_back({middle, half});
    return DrawnText{middle - Vector2d(0, half.y()), words, height_mm};
  }
  return std::nullopt;
}

}  // namespace misalign::schema
