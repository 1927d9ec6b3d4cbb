#include "solver/optimise/goal_functions.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>

#include "solver/bending/buckling.hpp"
#include "solver/bending/preload.hpp"
#include "solver/bending/rest_stiffness.hpp"
#include "solver/contact/contact.hpp"
#include "solver/optimise/chosen_friction.hpp"
#include "solver/optimise/deployed_angle.hpp"
#include "solver/optimise/local_goals.hpp"
#include "solver/optimise/shape_changes.hpp"
#include "solver/optimise/spare_diagonals.hpp"
#include "solver/optimise/strength_changes.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::solver {
namespace {

using Value = std::optional<double>;

// A member of a study's value, where there is one.
template <class Study, class Member>
Value member_of(const std::optional<Study>& study, Member member) {
  return study ? Value((*study).*member) : std::nullopt;
}

Value critical_friction(const Sheet& sheet, const OptimiseOptions& options) {
  const auto rigid = static_release(sheet, options.deploying);
  return rigid ? rigid->friction.critical_n_mm_per_mm : std::nullopt;
}

// Friction with bending panels; none where an equilibrium was lost.
std::optional<BentFriction> bent_friction(const Sheet& sheet, const OptimiseOptions& options) {
  const auto bent = bend_panels(sheet, options.deploying, options.bending);
  return bent && bent->unsure() == 0 ? std::optional(bent->friction) : std::nullopt;
}

Value bent_critical_friction(const Sheet& sheet, const OptimiseOptions& options) {
  return member_of(bent_friction(sheet, options), &BentFriction::critical_n_mm_per_mm);
}

Value static_friction(const Sheet& sheet, const OptimiseOptions& options) {
  return member_of(bent_friction(sheet, options), &BentFriction::static_n_mm_per_mm);
}

Value miscut_margin(const Sheet& sheet, const OptimiseOptions&) {
  return sheet.record().miscut_margin_mm;
}

Value stored_energy(const Sheet& sheet, const OptimiseOptions& options) {
  return springs_n_mm(sheet, options.deploying);
}

Value deployed_angle(const Sheet& sheet, const OptimiseOptions&) { return goes_until_deg(sheet); }

Value stiffness_at_rest(const Sheet& sheet, const OptimiseOptions& options) {
  return member_of(rest_stiffness(sheet, options.deploying, options.bending.material),
                   &RestStiffness::n_mm_per_rad);
}

Value plate_thickness(const Sheet& sheet, const OptimiseOptions& options) {
  const auto study = contact(sheet, {{}, options.used_from_deg});
  return study && study->thickness ? Value(study->thickness->thickness_mm) : std::nullopt;
}

Value largest_stress(const Sheet& sheet, const OptimiseOptions& options) {
  const auto bent = bend_panels(sheet, options.deploying, options.bending);
  return bent ? Value(-bent->most_bent().largest_stress_mpa) : std::nullopt;
}

Value buckling(const Sheet& sheet, const OptimiseOptions& options) {
  const auto bent = bend_panels(sheet, options.deploying, options.bending);
  if (!bent) return {};
  return find_buckling(sheet, options.deploying.sheet, *bent).least().factor;
}

// Springs that meet nothing have any clearance.
Value clearance_of_springs(const Sheet& sheet, const OptimiseOptions& options) {
  const auto study = contact(sheet, {{}, options.used_from_deg, options.bodies});
  if (!study || !study->springs) return {};
  const SpringMeeting* const met = closest_meeting(*study->springs);
  return met ? met->clear_mm : std::numeric_limits<double>::infinity();
}

Value share_of_copies(const Sheet& sheet, const OptimiseOptions& options) {
  return options.yield(sheet);
}

Value springs_spared(const Sheet& sheet, const OptimiseOptions& options) {
  const ReleaseOptions& deploying = options.deploying;
  const EnergyModel rigid(sheet, deploying.sheet);
  return member_of(spare_diagonals(sheet, rigid, *deploying.from_deg), &SpareDiagonals::amount);
}

Value shape_rms(const Sheet& sheet, const OptimiseOptions& options) {
  const auto off = options.shape->fitted(sheet);
  return off ? Value(-off->rms_mm()) : std::nullopt;
}

Value shape_max(const Sheet& sheet, const OptimiseOptions& options) {
  const auto off = options.shape->fitted(sheet);
  return off ? Value(-off->max_mm()) : std::nullopt;
}

struct Functions {
  std::string_view name;
  Value (*value)(const Sheet& sheet, const OptimiseOptions& options);
  std::vector<GoalTerm> (*linearization)(SheetChanges& changes);
};

constexpr Functions kFunctions[] = {
    {"critical_friction_n_mm_per_mm", critical_friction, local_critical_friction},
    {"bent_critical_friction_n_mm_per_mm", bent_critical_friction, local_bent_critical_friction},
    {"static_friction_n_mm_per_mm", static_friction, local_static_friction},
    {"chosen_friction_n_mm_per_mm", chosen_friction_n_mm_per_mm, local_chosen_friction},
    {"miscut_margin_mm", miscut_margin, local_margin},
    {"energy_n_mm", stored_energy, local_energy},
    {"deploys_from_deg", deployed_angle, local_deployed_angle},
    {"rest_stiffness_n_mm_per_rad", stiffness_at_rest, local_rest_stiffness},
    {"thickness_mm", plate_thickness, local_thickness},
    {"largest_stress_mpa", largest_stress, local_stress},
    {"buckling_factor", buckling, local_buckling},
    {"spring_clearance_mm", clearance_of_springs, local_spring_clearance},
    {"yield", share_of_copies, local_margin},
    {"spare_diagonals", springs_spared, local_spare_diagonals},
    {"shape_rms_mm", shape_rms, local_shape_rms},
    {"shape_max_mm", shape_max, local_shape_max},
};

const Functions& functions_of(const Goal& goal) {
  const auto* const functions = std::ranges::find(kFunctions, goal.name, &Functions::name);
  assert(functions != std::end(kFunctions));
  return *functions;
}

}  // namespace

Value value_of(const Goal& goal, const Sheet& sheet, const OptimiseOptions& options) {
  assert(options.shape || !goal.needs_target);
  return functions_of(goal).value(sheet, options);
}

std::vector<GoalTerm> linearization_of(const Goal& goal, SheetChanges& changes) {
  return functions_of(goal).linearization(changes);
}

}  // namespace misalign::solver
