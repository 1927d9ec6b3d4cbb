// Computes the play of ball joints as they are made: radius of the ball in which a joint settles.
//
// loop: a loop of wire through a bore in both panels, on the bisectors of their corners and `edge`
// off their sides. It is as long as the bores are apart at most, and lets them approach: at a state
// the vertex moves by the difference of both distances, and by the clearance of the wire in both
// bores.
// ball: a ball in a socket, with a diametral clearance.
// tab: a flexible strip along the difference of both bisectors, clamped to both panels when the
// sheet is flat. It bends as an arc of its free length L by an angle b; tangents at its ends meet
// (L/b) tan(b/2) away from them, and not L/2 as when it is flat.
#pragma once

#include "solver/play/joint_parts.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

struct JointPlay {
  double play_mm = 0;
  int ball = -1;  ///< the mechanism's joint with the largest play; -1: all have the same, or none
};

/// The largest play of a ball joint, flat and in the history's first `rows` rows.
JointPlay joint_play(const Sheet& sheet, const JointParts& parts, Eigen::Index rows);

}  // namespace misalign::solver
