// Ends of springs off the mid-planes, so that springs do not touch: the least offset, and what it
// does to the lengths of the springs.
#pragma once

#include <optional>
#include <vector>

#include "solver/contact/spring_clearance.hpp"

namespace misalign::solver {

/// Springs whose ends are raised.
enum class OffsetKind {
  alternate,  ///< the first of each hole above the mid-plane, the second below, by the same
  one_above   ///< the first of each hole above; the second in the mid-plane
};
inline constexpr OffsetKind kOffsetKinds[] = {OffsetKind::alternate, OffsetKind::one_above};

/// Offsets that are tried: multiples of this, up to twice the diameter.
inline constexpr double kOffsetStep_mm = 0.25;
/// Inset of springs that end on the vertices, by panel width: 8 mm on the paper's sheet.
inline constexpr double kInsetPart = 0.1;

struct OffsetEnds {
  OffsetKind kind;
  double inset_mm;                  ///< distance along the bisector of the panel's corner
  std::optional<double> offset_mm;  ///< least at which no two springs touch; none: too large
  SpringEnds ends{};                ///< those ends; as they were without an offset
  SpringMeetings springs{};         ///< meetings with those ends
  double deploys_from_deg = 0;      ///< D by the lengths between them
  int monotone = 0,
      diagonals = 0;  ///< number of diagonals monotone from `from_deg` to flat; of all
};

/// Judges both kinds between flat and `from_deg`, where the motion is resolved. Springs that end
/// beside their vertices keep their places in the plane.
std::vector<OffsetEnds> offset_ends(const Sheet& sheet, const PanelMotion& motion,
                                    const SpringBodies& bodies, double from_deg);

}  // namespace misalign::solver
