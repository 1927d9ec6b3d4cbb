// Bores for what joins panels at ball joints, and where springs end.
//
// Where two holes meet, the panels on both sides have a bore each, on the bisector of their corner,
// so near that --bore-edge is left between bore and edges: a loop of wire through both is the ball
// joint.
//
// A spring does what the verdict says of its diagonal if it ends on the vertices
// (SpringAt::vertex). At a ball joint it hangs in the joint itself, its loop of wire drawn tight: a
// bore on the vertex would have to be in both panels. At a whole vertex the panel across it has a
// tab, a disc round the vertex that reaches into the hole, with the bore in its middle. The two
// panels beside it are cut away round the disc: whichever way panels fold, all stay as far from the
// vertex as they are, so that nothing can meet the disc.
//
// SpringAt::panel: a bore at each end, at a whole vertex in the panel across it, which lies on the
// diagonal's own line or nearly; at a ball joint in the panel next to its hole, counter-clockwise
// round the vertex, so that the other hole's spring has the other panel. It lies behind the joint's
// bore. Such a panel turns as the sheet folds, and with it the bore: see kit_springs.hpp.
//
// A pattern whose springs end beside the vertices (solver::SpringEnds) has its bores there.
#pragma once

#include <vector>

#include "schema/kit/kit_options.hpp"
#include "schema/kit/panel_corner.hpp"

namespace misalign::schema {

struct Bore {
  int facet, vertex;  ///< in that panel, at that corner
  int spring;         ///< the diagonal's number; -1: of a ball joint
  Eigen::Vector2d centre_mm;
  double diameter_mm;  ///< as it comes out
};

/// A disc of a panel round one of its vertices. All as it comes out.
struct SpringTab {
  int facet, vertex;
  double radius_mm;  ///< of the disc
  double clear_mm;   ///< the other panels at the vertex are cut away as far from it
};

struct SpringEnd {
  int facet, vertex;  ///< moves with that panel
  int spring;         ///< the diagonal's number
  Eigen::Vector2d at_mm;
  double taken_mm;       ///< round it: by bore or tab
  double height_mm = 0;  ///< off the panel's mid-plane
};

struct KitFittings {
  std::vector<Bore> bores;  ///< of joints in the order of the mechanism's, then of springs
  std::vector<SpringTab> tabs;
  std::vector<SpringEnd>
      ends;  ///< two of each spring in the order of diagonals, `from` before `to`

  const SpringTab* tab_at(int vertex) const;  ///< null if there is none
};

/// What is asked for. UserError (bad_request), with what would fit, if a bore leaves its panel, a
/// tab has no room in its corner, one of them comes too close to another, or a bore is no larger
/// than the kerf.
KitFittings kit_fittings(const solver::Sheet& sheet, const KitOptions& options);

}  // namespace misalign::schema
