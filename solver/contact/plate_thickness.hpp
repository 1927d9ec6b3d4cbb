// Panels as plates of one thickness, and the largest with which a sheet folds as far as D.
//
// Hinges lie in the mid-planes. A plate is
// - tapered towards each of its creases, on the side to which it folds: by the plane through the
//   crease that makes the angle (180 - rho)/2 with the mid-plane, rho being the largest fold angle
//   of the crease on the way. The plate has its whole thickness t from (t/2) tan(rho/2) away from
//   the crease on, and neighbours touch all over their bevels just when rho is reached;
// - trimmed at each corner where it meets another panel in that point alone (ball joints, whole
//   vertices, corners of holes): by a line at right angles to the corner's bisector, `trim` away
//   from the vertex. That is more than a disc of that radius.
//
// Every point of a plate is within t/2 of its trimmed mid-plane. So plates without a common crease
// stay clear of each other if their trimmed mid-planes are never closer than t. This is sufficient,
// not necessary: plates that are tapered where they are closest may be thicker.
#pragma once

#include <vector>

#include "solver/contact/contact_finder.hpp"

namespace misalign::solver {

/// Corners of each panel at which it meets another one in that point alone: those that are trimmed.
std::vector<std::array<bool, 4>> trimmed_corners(const Panels& panels);
/// Mid-planes, trimmed: corners in turn, mm on the flat sheet (A1 at the origin).
std::vector<PolygonCorners> trimmed_panels(const Panels& panels, const FlatVertices& vertices_mm,
                                           double trim_mm);
/// The largest trim that leaves something of every edge, mm.
double largest_trim_mm(const Panels& panels, const FlatVertices& vertices_mm);

/// The share by which the thickness stays below the least distance of the mid-planes.
inline constexpr double kThicknessSlack = 1e-3;

struct PlateThickness {
  double thickness_mm;  ///< largest that reaches `end`; 0 where panels meet before
  enum class Limit { apart, vertex, taper } limit;
  /// Plates that limit it, and the angle at which they would meet.
  PanelPair pair{};
  double pilot_deg = 0;
  int panel = -1;                     ///< panel whose tapers meet
  double clear_mm = 0, taper_mm = 0;  ///< limits by clearance and by tapers alone
  std::vector<double> largest_rad;    ///< one per crease

  struct Taper {
    double thickness_mm;
    int panel;
  };
};

/// The largest thickness that every plate keeps somewhere on both sides, mm, and the panel that
/// limits it; infinity without creases. `largest_rad` has the largest |rho| of each crease.
PlateThickness::Taper taper_limit(const Panels& panels, const std::vector<PolygonCorners>& trimmed,
                                  const FlatVertices& vertices_mm,
                                  const std::vector<double>& largest_rad);

/// Largest thickness of plates that fold from flat up to `end` (x, where the motion is resolved).
/// `trim_mm` may be at most largest_trim_mm.
PlateThickness largest_thickness(const Panels& panels, const PanelMotion& motion, double end,
                                 double trim_mm);

}  // namespace misalign::solver
