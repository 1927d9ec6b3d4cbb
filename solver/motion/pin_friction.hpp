// The study of pins: friction that grows with the load of hinges and ball joints.
//
// A pin of radius r resists by mu r N, where N is the force across it and mu the coefficient of
// friction: so does a ring of wire in its bores. N and the driving moment are both proportional to
// the springs' stiffness, so that the largest mu r with which a sheet moves depends on its geometry
// alone. Forces are those of rigid panels held still by the pilot crease (joint_forces.hpp).
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/deploy.hpp"

namespace misalign::solver {

struct PinFriction {
  /// Moments at an angle, about the pilot crease: that which drives the sheet, and the loss by 1 mm
  /// of mu r.
  struct Row {
    double pilot_deg;
    double driving_n_mm;  ///< positive to flat: springs, elastic creases and weight
    double loss_n;        ///< sum of N |d fold angle| over hinges and ball joints
    /// Least mu r (mm) with which it does not move by itself: it locks.
    double locks_mm() const { return driving_n_mm > 0 ? driving_n_mm / loss_n : 0; }
  };

  std::vector<Row> rows;  ///< descending angles
  /// The largest mu r (mm) with which a sheet released at the start reaches flat. None: it does
  /// not.
  std::optional<double> critical_mm;
  const Row& locks_first() const;  ///< the least locks_mm
  /// The first angle on the way down at which a slow sheet locks; none: it moves down to the last.
  std::optional<double> stall_deg(double mu_r_mm) const;
};

/// Hinges with one pin in the middle, which takes moments by its sides without loss; and hinges
/// with a pin at each end, which take moments by a couple of forces.
struct PinStudy {
  double own_mm;  ///< the sheet's own mu r
  PinFriction in_middle, at_ends;
};

/// Studies pins from the start down to `to_deg`; the joints' forces are singular closer to flat.
/// Faults: those of the angles in `deploy`. Reasons: path_lost.
StudyResult<PinStudy> study_pins(const Sheet& sheet, const ReleaseOptions& deploying, double own_mm,
                                 double to_deg = kMarginTo_deg);

}  // namespace misalign::solver
