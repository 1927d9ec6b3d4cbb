// The outline of a part: its contours, and beside them the path of a beam that has a width.
#pragma once

#include <optional>
#include <vector>

#include "schema/kit/kit_bores.hpp"
#include "schema/kit/kit_parts.hpp"

namespace misalign::schema {

/// A closed contour, its material on the left; the last point is not the first one again.
using Ring = std::vector<Eigen::Vector2d>;

/// Vertices of the sheet along each contour of a part: the outer one first (counter-clockwise seen
/// from +z), then each opening (clockwise). Where two openings meet in a ball joint between two
/// panels of the part, each is a contour of its own, and they touch there.
std::vector<std::vector<int>> part_walks(const solver::Sheet& sheet, const KitPart& part);

/// The contour moved off its material by a distance, its corners mitred. A corner of the material
/// so acute that the mitre is longer than kMitreLimit distances is cut off there. Nothing if an
/// edge would vanish, or the contour meet itself.
std::optional<Ring> offset_ring(const Ring& ring, double distance_mm);
inline constexpr double kMitreLimit = 4;  // corners below 29 degrees

struct PartOutline {
  /// As part_walks, with tabs and what is cut away round them, moved off by half a kerf. Arcs are
  /// chords that leave them by at most kChordOff_mm.
  std::vector<Ring> rings;
  /// From a corner of one ring through the ball joint to that of another: where openings touch, and
  /// only half a kerf inside them is cut, a neck would be left. None without a kerf.
  std::vector<std::vector<Eigen::Vector2d>> slits;

  Eigen::Vector2d least_mm() const;
  Eigen::Vector2d most_mm() const;
};

inline constexpr double kChordOff_mm = 0.005;

/// UserError (bad_request) if the kerf is too wide for it.
PartOutline part_outline(const solver::Sheet& sheet, const KitPart& part,
                         const KitFittings& fittings, double kerf_mm);

/// Twice the area inside, positive if counter-clockwise, halved: mm^2.
double signed_area_mm2(const Ring& ring);

}  // namespace misalign::schema
