// Forces and moments in hinges and ball joints while a sheet deploys, from the balance of every
// panel.
//
// A hinge takes a force and, about its midpoint, a moment square to its crease (its friction turns
// about the crease); a ball joint takes a force. Joints that close no loop round a whole vertex
// have unique forces. The four creases round a whole vertex share an unknown common force through
// it, three self-stresses each: their forces have the least sum of squares, moments being divided
// by the crease's length.
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
    double from_deg = 1;  ///< the balance is singular closer to flat
    /// Forces on the diagonals at each row of the deployment, as where panels bend; empty: those of
    /// the rigid sheet.
    std::vector<Eigen::VectorXd> filling_forces_n{};
  };

  std::vector<double> pilot_deg;  ///< one per row
  /// Rows x 3 per crease: on the panel to its right, by the panel to its left (walking from a to
  /// b).
  Eigen::MatrixXd crease_force_n, crease_moment_n_mm;
  Eigen::MatrixXd crease_axis;      ///< rows x 3 per crease, from its a to its b
  Eigen::MatrixXd ball_force_n;     ///< rows x 3 per ball joint: on its second facet, by its first
  std::vector<bool> crease_shared;  ///< true if it ends at a whole vertex: one of many solutions
  /// Holding moment about the pilot crease at each row, against folding: the negative of the
  /// springs' moment. It is zero in a motion, except for its error.
  std::vector<double> holding_n_mm;
  int reactions, rank;
};

/// Finds forces at the rows of a deployment from `options.from_deg` on.
JointForces find_joint_forces(const EnergyModel& sheet, const FoldedShape& shape,
                              const PerforatedSheet& base, const Deployment& deployment,
                              const JointForces::Options& options = {});

}  // namespace misalign::solver
