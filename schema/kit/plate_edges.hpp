// Computes how far the contours of plates lie from their hinges, whose axes are at half thickness,
// or below all plates.
//
// Square edges that a film joins meet at the fold angle phi where they are t tan(phi/2) apart.
// Edges that are bevelled by phi/2 on the face on which the crease closes may reach the axis;
// bevels have whole degrees. A barrel round the axis needs its radius, and the distance from the
// axis of a plate's corner on the plane between both plates, t/2 / cos(phi/2). Plates
// above films in the plane of all axes keep the motion of panels without thickness, too: valleys
// need a gap of 2 h tan(phi/2) for plates up to the height h, and mountains none (offset panels:
// Edmondson et al. 2014). phi is the largest fold angle of all mountains, or all valleys, up to the
// angle of use.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "schema/kit/kit_options.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// A side of a panel, from one corner to the next one counter-clockwise.
struct PlateEdge {
  int crease = -1;  ///< the mechanism's; -1: no hinge
  bool valley = false;
  double back_mm = 0;    ///< distance of the contour from the axis
  double bevel_mm = 0;   ///< width of its bevel on the face on which the crease closes
  double bevel_deg = 0;  ///< angle of its bevel from square
};

/// The least misfit of hinges on faces that needs consent, in thicknesses.
inline constexpr double kMostMisfit = 0.1;

class PlateEdges {
 public:
  PlateEdges() = default;  ///< none: panels without thickness
  /// The sheet's history must have a station at the angle of use. UserError (bad_request) if the
  /// sheet folds nowhere, or hinges on faces miss by more than kMostMisfit without consent.
  PlateEdges(const solver::Sheet& sheet, const KitOptions& options);

  bool are_plates() const { return !edges_.empty(); }
  double thickness_mm() const { return thickness_mm_; }
  /// Largest distance of a plate's faces from the plane of its axes.
  double reach_mm() const { return reach_mm_; }
  /// The side of any panel at a hinge of a kind; its crease is -1.
  const PlateEdge& hinge(bool valley) const { return valley ? valley_ : mountain_; }
  /// The side of a panel after its corner `side`.
  const PlateEdge& edge(int facet, std::size_t side) const;
  /// Distances of the contour of a panel from its sides.
  std::array<double, 4> back_mm(int facet) const;
  /// The trim of a corner, along its bisector; 0: none.
  double trim_mm(int facet, std::size_t corner) const;
  /// The radius of a tab whose neck is as wide between edges that are set back as that of a tab of
  /// radius `bare_mm` between the panel's sides.
  double tab_radius_mm(const solver::Sheet& sheet, int facet, int vertex, double bare_mm) const;
  /// A sentence on hinges and gaps; empty without plates.
  const std::string& words() const { return words_; }

 private:
  double thickness_mm_ = 0, reach_mm_ = 0, trim_mm_ = 0;
  PlateEdge mountain_, valley_;
  std::vector<std::array<PlateEdge, 4>> edges_;  // by facet
  std::vector<std::array<bool, 4>> trimmed_;     // by facet
  std::string words_;
};

}  // namespace misalign::schema
