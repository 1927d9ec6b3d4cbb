#include "solver/motion/deploy.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "generated/features.hpp"

namespace misalign::solver {
namespace {

std::vector<double> wells_of(const std::vector<Equilibrium>& equilibria) {
  std::vector<double> wells_x;
  for (const Equilibrium& at : equilibria) {
    if (at.is_well) wells_x.push_back(at.x);
  }
  return wells_x;
}

// Fault of the first angle that does not lie on the way, as all must.
std::optional<OptionFault> angle_fault(const Sheet& sheet, const ReleaseOptions& options) {
  const FoldingWay& way = *sheet.way();
  double end_deg = way.end_deg();
  std::string reason =
      way.ends_at_limit() ? "reaches its fold limit" : "is followed no farther than";
  if (const auto over_deg = way.over_folded_deg(); over_deg && *over_deg < end_deg) {
    end_deg = *over_deg;
    reason = "has a crease folded to 180 deg";
  }
  std::optional<OptionFault> fault;
  if (!(options.motion.from_deg > 0)) {
    fault = {"from_deg", shown("%g", options.motion.from_deg), "is flat, where nothing is let go",
             "name an angle above 0"};
  }
  const auto check = [&](const char* name, const std::string& before, double angle_deg) {
    if (fault || angle_deg < end_deg) return;
    fault = {name, before + shown("%g", angle_deg),
             sheet.name() + " " + reason + " at " + shown("%.4f", end_deg) + " deg",
             "name a smaller angle"};
  };
  check("from_deg", "", options.motion.from_deg);
  check("rest_deg", "", rest_deg(options.sheet.fill));
  check("hinge_rest_deg", "", options.sheet.joints.rest_deg);
  const auto* const springs = std::get_if<Springs>(&options.sheet.fill);
  if (!springs) return fault;
  for (const auto& [diagonal, rest_deg] : springs->other_rests_deg) {
    const Diagonal& at = sheet.mechanism().diagonals[static_cast<std::size_t>(diagonal)];
    check("rest", line_label(at.from, at.to) + "= ", rest_deg);
  }
  return fault;
}

}  // namespace

std::optional<OptionFault> preload_fault(const Fill& fill) {
  const auto* const filled = std::get_if<Springs>(&fill);
  if (!filled || !filled->preload.is_any()) return {};
  const Springs& springs = *filled;
  const std::string value = shown("%g", springs.preload.largest_n());
  if (springs.rest_deg != 0 || !springs.other_rests_deg.empty()) {
    return OptionFault{"preload_n", value,
                       "is what springs are left with at flat, and these are relaxed at an angle",
                       "give one of the two"};
  }
  if (springs.pull_only && springs.on == SpringsOn::all) {
    return OptionFault{"preload_n", value,
                       "needs springs that push on the diagonals that shorten, and wires only pull",
                       "leave out one of the two, or have one spring a hole"};
  }
  return {};
}

std::optional<double> DeploymentStudy::deploy_time_s() const {
  const auto flat = std::find_if(run.rows.begin(), run.rows.end(), [](const Deployment::Row& row) {
    return row.event == Deployment::Event::flat;
  });
  if (flat != run.rows.end()) return flat->time_s;
  if (run.outcome == Outcome::flat) return run.last().time_s;
  return {};
}

std::optional<double> DeploymentStudy::barrier_n_mm() const {
  std::optional<double> flat, deepest;
  for (const Equilibrium& at : equilibria) {
    if (at.x == 0 && !at.is_well) flat = at.energy_n_mm;
    if (at.x > 0 && at.is_well)
      deepest = std::min(deepest.value_or(at.energy_n_mm), at.energy_n_mm);
  }
  if (!flat || !deepest) return {};
  return *flat - *deepest;
}

DeploymentStudy study_deployment(const Sheet& sheet, const EnergyModel::Options& energy,
                                 const Deployment::Options& options,
                                 const std::optional<JointForces::Options>& forces) {
  const EnergyModel deploying(sheet, energy);
  DeploymentStudy study{};
  study.sheet = energy;
  study.options = options;
  study.mass_t = deploying.mass_t();
  study.equilibria = find_equilibria(deploying);
  study.friction = find_friction_limits(deploying, options.from_deg);
  study.run = deploy(deploying, wells_of(study.equilibria), options);
  if (forces) {
    study.forces =
        find_joint_forces(deploying, sheet.model().shape(), sheet.base(), study.run, *forces);
  }
  if (rest_deg(energy.fill) == 0) return study;
  Eigen::VectorXd lengths_mm, rates_mm;
  const FoldingWay& way = *sheet.way();
  way.find_lengths(way.x_of(rest_deg(energy.fill)), lengths_mm, rates_mm);
  for (int d = 0; d < sheet.mechanism().diagonal_count(); ++d) {
    (rates_mm(d) > 0 ? study.pulls_from_above : study.pulls_from_below).push_back(d);
  }
  return study;
}

std::optional<double> critical_friction_in_motion(const Sheet& sheet,
                                                  const EnergyModel::Options& energy,
                                                  const Deployment::Options& options,
                                                  double relative) {
  EnergyModel::Options tried = energy;
  const auto arrives = [&](double friction_n_mm_per_mm) {
    tried.joints.friction_n_mm_per_mm = friction_n_mm_per_mm;
    const EnergyModel deploying(sheet, tried);
    const Outcome outcome =
        deploy(deploying, wells_of(find_equilibria(deploying)), options).outcome;
    return outcome == Outcome::passed_flat || outcome == Outcome::latched ||
           outcome == Outcome::flat;
  };
  tried.joints.friction_n_mm_per_mm = 0;
  const EnergyModel without(sheet, tried);
  const auto bound = find_friction_limits(without, options.from_deg).critical_n_mm_per_mm;
  if (!bound || !arrives(0)) return {};
  double arriving = 0, held = *bound * (1 + relative);  // damping lets it bear no more
  assert(held > arriving);
  while (held - arriving > relative * held) {
    const double middle = (arriving + held) / 2;
    (arrives(middle) ? arriving : held) = middle;
  }
  return arriving;
}

std::optional<LeastDamping> least_damping(const std::function<Deployment(double)>& let_go) {
  if (let_go(0).outcome != Outcome::passed_flat) return {};
  constexpr double kSome = 1e-6, kMost = 1e9;
  double passing = 0, resting = kSome;
  Deployment run = let_go(resting);
  for (; run.outcome == Outcome::passed_flat && resting < kMost; run = let_go(resting)) {
    passing = resting;
    resting *= 4;
  }
  while (resting - passing > kDampingWithin * resting) {
    assert(passing < resting);
    const double middle = passing > 0 ? std::sqrt(passing * resting) : resting / 2;
    Deployment tries = let_go(middle);
    if (tries.outcome == Outcome::passed_flat) {
      passing = middle;
    } else {
      resting = middle;
      run = std::move(tries);
    }
  }
  if (run.outcome != Outcome::flat) return {};
  return LeastDamping{resting, run.last().time_s};
}

StudyResult<ReleaseOptions> validated_release(const Sheet& sheet, const ReleaseOptions& options) {
  if (!sheet.way()) return NoResult::path_lost;
  ReleaseOptions from = options;
  from.motion.from_deg = options.from_deg.value_or(kDeployFrom_deg);
  if (!options.from_deg && sheet.deploys_from_deg() > 0) {
    from.motion.from_deg = std::min(from.motion.from_deg, sheet.deploys_from_deg());
  }
  if (auto fault = angle_fault(sheet, from)) return *fault;
  if (auto fault = preload_fault(options.sheet.fill)) return *fault;
  return from;
}

StudyResult<StaticRelease> static_release(const Sheet& sheet, const ReleaseOptions& options) {
  const StudyResult<ReleaseOptions> fitted = validated_release(sheet, options);
  if (!fitted) return fitted.obstacle();
  const FoldingWay& way = *sheet.way();
  const double from_deg = fitted->motion.from_deg;
  const EnergyModel deploying(sheet, options.sheet);
  return StaticRelease{from_deg, deploying.at(way.x_of(from_deg)).filling_n_mm,
                       find_friction_limits(deploying, from_deg)};
}

std::optional<double> springs_n_mm(const Sheet& sheet, const ReleaseOptions& options) {
  if (const auto study = static_release(sheet, options)) return study->springs_n_mm;
  // The energy comes from the solved state: ways are inexact next to folded flat.
  if (!sheet.way() || sheet.rows_up_to_d() == 0 || options.from_deg != sheet.deploys_from_deg() ||
      preload_fault(options.sheet.fill)) {
    return {};
  }
  return filling_of(sheet, options.sheet.fill)
      .energy_n_mm(sheet.history().length_mm.row(sheet.rows_up_to_d() - 1));
}

StudyResult<DeploymentStudy> deploy(const Sheet& sheet, const ReleaseOptions& options) {
  if constexpr (!has("SUNDIALS")) return NoResult::not_in_this_build;
  const StudyResult<ReleaseOptions> fitted = validated_release(sheet, options);
  if (!fitted) return fitted.obstacle();
  const Deployment::Options& motion = fitted->motion;
  DeploymentStudy study = study_deployment(sheet, options.sheet, motion, options.forces);
  if (options.sheet.joints.damping_n_mm_s_per_mm > 0) {
    study.friction.critical_n_mm_per_mm = critical_friction_in_motion(sheet, options.sheet, motion);
  }
  study.seeks_damping = options.seeks_damping;
  if (options.seeks_damping) {
    Deployment::Options bare = motion;
    bare.latch = false;
    bare.restitution = {};
    bare.swings = 0;
    study.least_damping = least_damping([&](double damping) {
      EnergyModel::Options tried = options.sheet;
      tried.joints.damping_n_mm_s_per_mm = damping;
      const EnergyModel deploying(sheet, tried);
      return deploy(deploying, wells_of(find_equilibria(deploying)), bare);
    });
  }
  return study;
}

}  // namespace misalign::solver
