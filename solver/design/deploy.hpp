// The study of one sheet's deployment: its motion after release, where it may rest, and what
// friction it overcomes.
#pragma once

#include "solver/design/deployment.hpp"
#include "solver/design/equilibria.hpp"
#include "solver/design/joint_forces.hpp"

namespace misalign::solver {

struct DeploymentStudy {
  DeployingSheetOptions sheet;
  DeploymentOptions options;
  double mass_t;
  std::vector<Equilibrium> equilibria;
  FrictionLimits friction;
  Deployment run;
  /// Where springs are relaxed on the way: the diagonals that are longer above that angle, where
  /// theirs pull back towards it, and those that are longer below. None where they are relaxed
  /// flat.
  std::vector<int> pulls_from_above, pulls_from_below;
  std::optional<JointForces> forces;  ///< where they are asked for

  /// When it was first flat.
  std::optional<double> deploy_time_s() const;
  /// What is between the start's side and its mirror image: the energy flat above that of the
  /// deepest well on this side; none where flat is a well.
  std::optional<double> barrier_n_mm() const;
};

/// `options.from_deg` and the angles at which springs and creases are relaxed must lie on the way.
/// With the forces in the joints if `forces` says how.
DeploymentStudy study_deployment(const FoldingWay& way, const Model& model,
                                 const DeployingSheetOptions& sheet,
                                 const DeploymentOptions& options,
                                 const std::optional<JointForcesOptions>& forces = {});

/// The largest crease friction with which it gets to flat, damping and all, by letting it go again
/// and again: to `relative` of itself. None if it does not get there without friction.
std::optional<double> critical_friction_in_motion(const FoldingWay& way, const Model& model,
                                                  const DeployingSheetOptions& sheet,
                                                  const DeploymentOptions& options,
                                                  double relative = 1e-4);

}  // namespace misalign::solver
