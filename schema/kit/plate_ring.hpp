// Computes the contour and the faces of a plate: set back from its hinges, trimmed at corners, with
// tabs.
#pragma once

#include <array>
#include <optional>

#include "schema/kit/kit_bores.hpp"
#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

/// A closed line round a plate, counter-clockwise. The number of its points does not depend on the
/// distances from the panel's sides, so that some may coincide.
struct PlateRing {
  PlanePoints points;
  std::array<std::size_t, 4> begins;  ///< the first point of each side, after the panel's corner

  /// The ends of a side.
  std::array<Eigen::Vector2d, 2> side(std::size_t k) const {
    return {points[begins[k]], points[(begins[k] + 1) % points.size()]};
  }
};

/// The ring at other distances from the panel's sides than the contour's, none of them less. The
/// sides of a tab's panel end where the contour meets the tab's disc. None if nothing is left of a
/// side.
std::optional<PlateRing> plate_ring(const solver::Sheet& sheet, int facet,
                                    const KitFittings& fittings,
                                    const std::array<double, 4>& back_mm);

/// Faces of plates: valleys close on the upper one.
enum class PlateFace { upper, lower };

/// The outline of a face, within its bevels. UserError (bad_request) if nothing is left of a side.
PlateRing plate_face(const solver::Sheet& sheet, int facet, const KitFittings& fittings,
                     PlateFace face);

/// The contour, without points that coincide. UserError (bad_request) as of its faces.
PlanePoints plate_contour(const solver::Sheet& sheet, int facet, const KitFittings& fittings);

}  // namespace misalign::schema
