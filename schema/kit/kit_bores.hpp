// Places the bores of ball joints and of springs.
//
// The panels on both sides of a vertex where two holes meet have a bore each on the bisector of
// their corner, --bore-edge from the edges. A loop of wire through both is the ball joint.
//
// A spring that ends on the vertices (SpringAt::vertex) moves like its diagonal. At a ball joint it
// hangs in the joint's tight loop of wire: a bore on the vertex would have to be in both panels. At
// a whole vertex the opposite panel has a tab, a disc round the vertex that reaches into the hole,
// with the bore in its middle. The two panels beside it are cut away round the disc. Folding keeps
// their distance from the vertex, so that nothing can meet the disc.
//
// SpringAt::panel places a bore at each end. At a whole vertex it is in the opposite panel, on the
// diagonal's line or nearly. At a ball joint it is in the next panel counter-clockwise round the
// vertex, so that the other hole's spring has the other panel; it lies behind the joint's bore.
// Such a panel turns with its bore as the sheet folds: see kit_springs.hpp.
//
// Plates have tabs with necks as wide as without hinges. Panels beside one are cut clear of all of
// its thickness, and straight. Bores keep off contours and bevels.
//
// A pattern whose springs end beside the vertices (solver::SpringEnds) has its bores at these ends.
#pragma once

#include <vector>

#include "schema/kit/kit_options.hpp"
#include "schema/kit/panel_corner.hpp"
#include "schema/kit/plate_edges.hpp"

namespace misalign::schema {

struct Bore {
  int facet, vertex;  ///< the panel, and its corner
  int spring;         ///< the diagonal's number; -1: a ball joint's bore
  Eigen::Vector2d centre_mm;
  double diameter_mm;  ///< diameter of the cut bore
};

inline constexpr double kTabSlot_mm = 1;  ///< drawn distance of a tab from the panels beside it

/// A disc of a panel round one of its vertices; sizes after cutting.
struct SpringTab {
  int facet, vertex;
  double radius_mm;  ///< radius of the disc
  double clear_mm;   ///< distance from the vertex within which other panels are cut away
};

struct SpringEnd {
  int facet, vertex;  ///< moves with that panel
  int spring;         ///< the diagonal's number
  Eigen::Vector2d at_mm;
  double taken_mm;       ///< radius of its bore or tab
  double height_mm = 0;  ///< height above the panel's mid-plane
};

struct KitFittings {
  std::vector<Bore> bores;  ///< joints in the mechanism's order, then springs
  std::vector<SpringTab> tabs;
  std::vector<SpringEnd> ends;  ///< two for each diagonal in order, `from` before `to`
  PlateEdges edges;             ///< none: panels without thickness

  const SpringTab* tab_at(int vertex) const;  ///< null if there is none
};

/// Bores, tabs and ends of a kit. UserError (bad_request), with sizes that would fit, if a bore
/// leaves its panel, a tab has no room in its corner, one of them is too close to another, or a
/// bore is no larger than the kerf.
KitFittings kit_fittings(const solver::Sheet& sheet, const KitOptions& options);

}  // namespace misalign::schema
