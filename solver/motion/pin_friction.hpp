// The study of pins: friction that grows with the load of hinges and ball joints.
//
// A pin of radius r resists by mu r N, where N is the force across it and mu the coefficient of
// friction: so does a ring of wire in its bores. N and what drives the sheet both go with the
// springs' stiffness, and mu r with which a sheet still moves is a length of its geometry alone.
// Forces are those of rigid panels held still by the pilot crease (joint_forces.hpp).
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/deploy.hpp"

namespace misalign::solver {

struct PinFriction {
  /// The moments at an angle: what drives the sheet, and what 1 mm of mu r takes of it, both by the
  /// pilot's angle.
  struct Row {
    double pilot_deg;
    double driving_n_mm;  ///< to flat: springs, elastic creases and weight
    double loss_n;        ///< sum of N |d fold angle| over hinges and ball joints
    /// The mu r (mm) from which on it does not move on by itself: it locks.
    double locks_mm() const { return driving_n_mm > 0 ? driving_n_mm / loss_n : 0; }
  };

  std::vector<Row> rows;  ///< from the start down
  /// The largest mu r (mm) with which a sheet let go at the start gets to flat. None: it does not.
  std::optional<double> critical_mm;
  const Row& locks_first() const;  ///< the least locks_mm
  /// The first angle on the way down from which a sheet that moves slowly is locked; none: it moves
  /// on down to the last.
  std::optional<double> stall_deg(double mu_r_mm) const;
};

/// Of hinges with one pin in the middle, which takes moments by its sides without loss; and of
/// hinges with one at each end, which take them by a couple of forces.
struct PinStudy {
  double own_mm;  ///< the sheet's own mu r
  PinFriction in_middle, at_ends;
};

/// From the start down to `to_deg`; closer to flat the joints' forces are singular. Faults: of the
/// angles as `deploy`. Reasons: path_lost.
StudyResult<PinStudy> study_pins(const Sheet& sheet, const ReleaseOptions& deploying, double own_mm,
                                 double to_deg = kMarginTo_deg);

}  // namespace misalign::solver
