// Bores for what joins panels at ball joints, and for springs.
//
// Where two holes meet, the panels on both sides have a bore each, on the bisector of their corner,
// so near that --bore-edge is left between bore and edges: a loop of wire through both is the ball
// joint. A spring of a diagonal hangs in a bore at each end: at a whole vertex in the panel across
// it, which lies on the diagonal's own line or nearly; at a ball joint in the panel next to its
// hole, counter-clockwise round the vertex, so that the other hole's spring has the other panel. It
// lies behind the joint's bore.
#pragma once

#include <optional>
#include <vector>

#include "schema/kit/kit_options.hpp"
#include "schema/kit/kit_sheet.hpp"

namespace misalign::schema {

struct Bore {
  int facet, vertex;  ///< in that panel, at that corner
  int spring;         ///< the diagonal's number; -1: of a ball joint
  Eigen::Vector2d centre_mm;
  double diameter_mm;  ///< as it comes out
};

/// Those that are asked for: of joints in the order of the mechanism's, then of springs; a spring's
/// `from` before its `to`. UserError (2), with what would fit, if one leaves its panel or comes too
/// close to another, or is no larger than the kerf.
std::vector<Bore> kit_bores(const KitSheet& sheet, const KitOptions& options);

}  // namespace misalign::schema
