// Forces and moments in hinges and ball joints while a sheet deploys, from the balance of every
// panel.
//
// A hinge takes a force and, about its midpoint, a moment square to its crease (its friction turns
// about the crease); a ball joint takes a force. Joints that close no loop round a whole vertex
// have one answer. Round a whole vertex the four creases share an unknown common force through it,
// three self-stresses each: there the answer with the least squares of forces, and of moments over
// the crease's length, is given.
#pragma once

#include "solver/motion/deployment.hpp"
#include "solver/motion/moving_mass.hpp"

namespace misalign::solver {

/// Vectors in the flat coordinates of the first panel, as seen from +z.
struct JointForces {
  struct Options {
    /// The sheet is in motion, with inertia and the joints' resistance; or held at each row by a
    /// moment about the pilot crease, nothing moving.
    bool in_motion = true;
    double from_deg = 1;  ///< closer to flat the balance is singular
  };

  std::vector<double> pilot_deg;  ///< of the rows
  /// Rows x 3 per crease: on the panel to its right, by the one to its left (walking from a to b).
  Eigen::MatrixXd crease_force_n, crease_moment_n_mm;
  Eigen::MatrixXd crease_axis;      ///< rows x 3 per crease, from its a to its b
  Eigen::MatrixXd ball_force_n;     ///< rows x 3 per ball joint: on its second facet, by its first
  std::vector<bool> crease_shared;  ///< whether it ends at a whole vertex: one of many answers
  /// About the pilot crease, against folding: what holds the sheet at each row, the springs' moment
  /// turned round. In a motion nothing, but for how exact it is.
  std::vector<double> holding_n_mm;
  int reactions, rank;
};

/// At the rows of a deployment that are that far from flat; `options` are the sheet's.
JointForces find_joint_forces(const EnergyModel& sheet, const FoldedShape& shape,
                              const PerforatedSheet& base, const Deployment& deployment,
                              const JointForces::Options& options = {});

}  // namespace misalign::solver
