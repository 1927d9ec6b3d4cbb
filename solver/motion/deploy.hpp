// The study of one sheet's deployment: its motion after release, its equilibria, and the friction
// that it overcomes.
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
  Deployment::Options motion;                  ///< except for its start
  std::optional<JointForces::Options> forces;  ///< none: forces are not computed
  bool seeks_damping = false;  ///< true: finds the least damping with which it does not pass flat
};

/// The least damping of the creases (N mm s per mm) with which a sheet comes to rest flat without
/// passing through it, to a relative kDampingWithin.
inline constexpr double kDampingWithin = 1e-3;
struct LeastDamping {
  double damping_n_mm_s_per_mm, time_s;  ///< and the time of that deployment
};

struct DeploymentStudy {
  EnergyModel::Options sheet;
  Deployment::Options options;
  double mass_t;
  std::vector<Equilibrium> equilibria;
  FrictionLimits friction;
  Deployment run;
  /// Diagonals that are longer above the angle at which springs are relaxed on the way, so that
  /// their springs pull back towards it, and diagonals that are longer below. Empty where springs
  /// are relaxed flat.
  std::vector<int> pulls_from_above, pulls_from_below;
  std::optional<JointForces> forces;  ///< present if requested
  bool seeks_damping = false;         ///< true if requested
  std::optional<LeastDamping> least_damping;

  /// Time at which it was first flat.
  std::optional<double> deploy_time_s() const;
  /// Energy barrier between the start's side and its mirror image: the energy at flat above that of
  /// the deepest well on this side; none where flat is a well.
  std::optional<double> barrier_n_mm() const;
};

/// Results at its start, without a motion.
struct StaticRelease {
  double from_deg, springs_n_mm;  ///< angle of use, and the springs' energy there
  FrictionLimits friction;
};

/// `let_go` releases it with this damping, until it passes flat or rests. None where friction or
/// the time limit ends that first, or where no damping is needed.
std::optional<LeastDamping> least_damping(const std::function<Deployment(double)>& let_go);

/// `options.from_deg` and the angles at which springs and creases are relaxed must lie on the way.
/// Forces in the joints are computed if `forces` is given.
DeploymentStudy study_deployment(const Sheet& sheet, const EnergyModel::Options& energy,
                                 const Deployment::Options& options,
                                 const std::optional<JointForces::Options>& forces = {});

/// The largest crease friction with which it reaches flat, damping included, by repeated motions,
/// to a relative `relative`. None if it does not reach flat without friction.
std::optional<double> critical_friction_in_motion(const Sheet& sheet,
                                                  const EnergyModel::Options& energy,
                                                  const Deployment::Options& options,
                                                  double relative = 1e-4);

/// Returns the options with their start (in `motion`) set, once the start and all other angles lie
/// on the sheet's way and springs can have their preload. Studies of a release begin with it.
/// Reasons: path_lost.
StudyResult<ReleaseOptions> validated_release(const Sheet& sheet, const ReleaseOptions& options);
/// The same without the motion, and so at a tenth of the cost. Faults as those of deploy().
/// Reasons: path_lost.
StudyResult<StaticRelease> static_release(const Sheet& sheet, const ReleaseOptions& options = {});
/// The energy of the springs at the angle of use, also at a D of 180 degrees, where the sheet is
/// folded flat and nothing moves it. None where the angle is 0 or does not lie on its way.
std::optional<double> springs_n_mm(const Sheet& sheet, const ReleaseOptions& options);

/// Fault (preload_n) of springs that have a preload, and are relaxed at an angle or only pull: a
/// preload replaces the angle at which springs are relaxed.
std::optional<OptionFault> preload_fault(const Fill& fill);

/// Releases a sheet. Faults: the start is flat; or it, or an angle at which springs or creases are
/// relaxed, does not lie on its way. With damping the critical friction is the one in motion.
/// Reasons: path_lost; not_in_this_build, without SUNDIALS.
StudyResult<DeploymentStudy> deploy(const Sheet& sheet, const ReleaseOptions& options = {});

}  // namespace misalign::solver
