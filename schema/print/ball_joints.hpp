// Makes printed ball joints: a ball on the corner of one plate, in a socket on that of the other.
//
// The middle of the ball is the vertex. A neck along the bisector of the first panel's corner holds
// it; a stem along that of the second one's holds the socket, a hollow ball that is open in a cone.
// The cone is the smallest round all directions in which the neck leaves the socket between flat
// and the angle of use, and wider by the neck. Its rim is narrower than the ball, which snaps in.
#pragma once

#include <vector>

#include "schema/kit/kit_options.hpp"
#include "schema/print/solid.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// The rim of a socket, as a share of the ball's radius, at most.
inline constexpr double kMostRim = 0.97;
/// The least wall of a socket, and its share of the ball's radius.
inline constexpr double kSocketWall_mm = 0.8, kSocketWallPart = 0.3;
/// The least diametral clearance of balls, with which printed ones do not fuse.
inline constexpr double kLeastBallClearance_mm = 0.1;
/// The neck's radius, as a share of the ball's.
inline constexpr double kNeckPart = 0.45;

/// Sizes of a joint, radii.
struct BallSizes {
  double ball_mm, socket_mm, outer_mm, neck_mm;

  explicit BallSizes(const KitOptions& options);
};

/// Adds balls and sockets to the plates (in the order of panels), as closed shells that reach into
/// them. UserError (bad_request) where corners are trimmed by less than a socket needs, or a ball
/// would not be held.
void add_ball_joints(const solver::Sheet& sheet, const KitOptions& options,
                     std::vector<Solid>& plates);

}  // namespace misalign::schema
