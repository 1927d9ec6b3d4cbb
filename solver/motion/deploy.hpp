// The study of one sheet's deployment: its motion after release, where it may rest, and what
// friction it overcomes.
#pragma once

#include <functional>

#include "solver/motion/deployment.hpp"
#include "solver/motion/equilibria.hpp"
#include "solver/motion/joint_forces.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/studies/study_result.hpp"
#include "solver/studies/wanted.hpp"

namespace misalign::solver {

struct ReleaseOptions {
  std::optional<double> from_deg;  ///< none: kDeployFrom_deg, or D where that is less
  EnergyModel::Options sheet;
  Deployment::Options motion;                  ///< but for its start
  std::optional<JointForces::Options> forces;  ///< none: they are not found
  bool seeks_damping = false;                  ///< the least with which it does not pass flat
};

/// The least damping of the creases (N mm s per mm) with which a sheet comes to rest flat without
/// passing through it: to kDampingWithin of itself.
inline constexpr double kDampingWithin = 1e-3;
struct LeastDamping {
  double damping_n_mm_s_per_mm, time_s;  ///< and how long it then takes
};

struct DeploymentStudy {
  EnergyModel::Options sheet;
  Deployment::Options options;
  double mass_t;
  std::vector<Equilibrium> equilibria;
  FrictionLimits friction;
  Deployment run;
  /// Where springs are relaxed on the way: the diagonals that are longer above that angle, where
  /// theirs pull back towards it, and those that are longer below. None where they are relaxed
  /// flat.
  std::vector<int> pulls_from_above, pulls_from_below;
  std::optional<JointForces> forces;  ///< where they are asked for
  bool seeks_damping = false;         ///< whether that was asked for
  std::optional<LeastDamping> least_damping;

  /// When it was first flat.
  std::optional<double> deploy_time_s() const;
  /// What is between the start's side and its mirror image: the energy flat above that of the
  /// deepest well on this side; none where flat is a well.
  std::optional<double> barrier_n_mm() const;
};

/// What holds at its start, and no motion is needed for.
struct StaticRelease {
  double from_deg, springs_n_mm;  ///< where it is let go, and the energy of the springs there
  FrictionLimits friction;
};

/// `let_go`: with this damping, until it passes flat or rests. None where friction or the time
/// limit ends it first, or where it needs none.
std::optional<LeastDamping> least_damping(const std::function<Deployment(double)>& let_go);

/// `options.from_deg` and the angles at which springs and creases are relaxed must lie on the way.
/// With the forces in the joints if `forces` says how.
DeploymentStudy study_deployment(const Sheet& sheet, const EnergyModel::Options& energy,
                                 const Deployment::Options& options,
                                 const std::optional<JointForces::Options>& forces = {});

/// The largest crease friction with which it gets to flat, damping and all, by letting it go again
/// and again: to `relative` of itself. None if it does not get there without friction.
std::optional<double> critical_friction_in_motion(const Sheet& sheet,
                                                  const EnergyModel::Options& energy,
                                                  const Deployment::Options& options,
                                                  double relative = 1e-4);

/// The same with the start that is meant (in `motion`), where it lies on the sheet's way as all
/// other angles do, and springs can have their preload: what studies of a release begin with.
/// Reasons: path_lost.
StudyResult<ReleaseOptions> validated_release(const Sheet& sheet, const ReleaseOptions& options);
/// The same without the motion, and so at a tenth of the cost. Faults as those of deploy().
/// Reasons: path_lost.
StudyResult<StaticRelease> static_release(const Sheet& sheet, const ReleaseOptions& options = {});
/// The energy of the springs where it would be let go, at a D of 180 degrees too, where it is
/// folded flat and nothing moves it. None where the angle is 0 or does not lie on its way.
std::optional<double> springs_n_mm(const Sheet& sheet, const ReleaseOptions& options);

/// Lets a sheet go. Faults: the start is flat; or it, or an angle at which springs or creases are
/// relaxed, does not lie on its way. With damping the critical friction is the one in motion.
/// Reasons: path_lost; not_in_this_build, where it is without SUNDIALS.
StudyResult<DeploymentStudy> deploy(const Sheet& sheet, const ReleaseOptions& options = {});

}  // namespace misalign::solver
