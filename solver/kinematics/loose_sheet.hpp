// Represents a sheet whose joints have play: each lies a little off its place, and stays there
// while the sheet folds.
//
// A hinge between panels f and g (f left of it, a to b): in f's frame its line passes a + d_a and
// b + d_b. So g is displaced by S and then turned by the fold angle about its own line, where S is
// the smallest rotation to the new direction that puts a at a + d_a: play along the line is taken
// there. A ball joint's centre is off by d: S is a translation.
//
// Loops round holes close all six equations with these displacements. The four lines of a whole
// vertex no longer meet in a point, and four hinges with six equations would lock: there only the
// rotation closes, (3.1), and `vertex_gap` is the translation that is left for their play to take
// up.
#pragma once

#include <vector>

#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {

/// Offsets of each joint, in any unit, in the frame of the facet that a passage of sense +1 leaves.
struct JointOffsets {
  std::vector<Vec3<double>> creases_a, creases_b;  ///< hinge lines' offsets at vertices a and b
  std::vector<Vec3<double>> balls;                 ///< centres' offsets
};

/// The SheetGeometry of the sheet as designed, with displacements at its joints. Functions that
/// take a SheetGeometry, not any geometry, do not see the play.
template <class T>
struct LooseSheet : SheetGeometry<T> {
  std::vector<Pose<T>> creases, balls;  ///< S of each, panel widths

  const Pose<T>& displacement(const Passage& passage) const {
    return passage.ball ? balls[passage.joint] : creases[passage.joint];
  }
};

/// The sheet with `scale` (panel widths per unit) of these offsets, small against its edges.
void loosen(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
            const JointOffsets& offsets, double scale, LooseSheet<double>& sheet);

/// Makes the pilot's fold angle in a state count downwards from `top`: a follower that only ascends
/// then unfolds the sheet.
void count_pilot_down(const Mechanism& mechanism, const HalfAngle<double>& top,
                      LooseSheet<double>& sheet);

/// Largest translation, panel widths, that is left round any whole vertex; 0 if there is none.
double vertex_gap(const Mechanism& mechanism, const LooseSheet<double>& sheet,
                  const FoldState<double>& state);

}  // namespace misalign::solver
