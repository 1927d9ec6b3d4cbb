// Computes the outline of a part: its contours, offset by half a kerf.
#pragma once

#include <optional>
#include <vector>

#include "schema/kit/kit_bores.hpp"
#include "schema/kit/kit_parts.hpp"

namespace misalign::schema {

/// A closed contour, its material on the left; the first point is not repeated at the end.
using Ring = std::vector<Eigen::Vector2d>;

/// Vertices of the sheet along each contour of a part: the outer one first (counter-clockwise seen
/// from +z), then each opening (clockwise). Where two openings meet in a ball joint between two
/// panels of the part, each is a contour of its own, and they touch there.
std::vector<std::vector<int>> part_walks(const solver::Sheet& sheet, const KitPart& part);

/// The contour offset from its material by a distance, with mitred corners. A mitre longer than
/// kMitreLimit distances is cut off. Nothing if an edge would vanish, or the contour meet itself.
std::optional<Ring> offset_ring(const Ring& ring, double distance_mm);
inline constexpr double kMitreLimit = 4;  // corners below 29 degrees

struct PartOutline {
  /// Contours of part_walks with tabs and their clearances, or of a plate with hinges, offset by
  /// half a kerf. Arcs are chords within kChordOff_mm.
  std::vector<Ring> rings;
  /// Cuts from a corner of one ring through a ball joint to that of another: where openings touch,
  /// contours half a kerf inside them would leave a neck. None without a kerf.
  std::vector<std::vector<Eigen::Vector2d>> slits;
};

/// The outline of a part. UserError (bad_request) if the kerf is too wide.
PartOutline part_outline(const solver::Sheet& sheet, const KitPart& part,
                         const KitFittings& fittings, double kerf_mm);

/// The area inside, positive if counter-clockwise.
double signed_area_mm2(const Ring& ring);

}  // namespace misalign::schema
