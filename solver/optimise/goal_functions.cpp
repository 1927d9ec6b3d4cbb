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

Value critical_friction(GoalValues& values) {
  const auto rigid = static_release(values.sheet(), values.options().deploying);
  return rigid ? rigid->friction.critical_n_mm_per_mm : std::nullopt;
}

// Friction with bending panels; none where an equilibrium was lost.
std::optional<BentFriction> bent_friction(GoalValues& values) {
  const auto& bent = values.bent();
  return bent && bent->unsure() == 0 ? std::optional(bent->friction) : std::nullopt;
}

Value bent_critical_friction(GoalValues& values) {
  return member_of(bent_friction(values), &BentFriction::critical_n_mm_per_mm);
}

Value static_friction(GoalValues& values) {
  return member_of(bent_friction(values), &BentFriction::static_n_mm_per_mm);
}

Value chosen_friction(GoalValues& values) {
  return chosen_friction_n_mm_per_mm(values.sheet(), values.options());
}

Value miscut_margin(GoalValues& values) { return values.sheet().record().miscut_margin_mm; }

Value stored_energy(GoalValues& values) {
  return springs_n_mm(values.sheet(), values.options().deploying);
}

Value deployed_angle(GoalValues& values) { return goes_until_deg(values.sheet()); }

Value stiffness_at_rest(GoalValues& values) {
  return member_of(
      rest_stiffness(values.sheet(), values.options().deploying, values.options().bending.material),
      &RestStiffness::n_mm_per_rad);
}

Value plate_thickness(GoalValues& values) {
  const auto study = contact(values.sheet(), {{}, values.options().used_from_deg});
  return study && study->thickness ? Value(study->thickness->thickness_mm) : std::nullopt;
}

Value largest_stress(GoalValues& values) {
  const auto& bent = values.bent();
  return bent ? Value(-bent->most_bent().largest_stress_mpa) : std::nullopt;
}

Value buckling(GoalValues& values) {
  const auto& bent = values.bent();
  if (!bent) return {};
  return find_buckling(values.sheet(), values.options().deploying.sheet, *bent).least().factor;
}

// Springs that meet nothing have any clearance.
Value clearance_of_springs(GoalValues& values) {
  const auto study =
      contact(values.sheet(), {{}, values.options().used_from_deg, values.options().bodies});
  if (!study || !study->springs) return {};
  const SpringMeeting* const met = closest_meeting(*study->springs);
  return met ? met->clear_mm : std::numeric_limits<double>::infinity();
}

Value share_of_copies(GoalValues& values) { return values.options().yield(values.sheet()); }

Value springs_spared(GoalValues& values) {
  const ReleaseOptions& deploying = values.options().deploying;
  const EnergyModel rigid(values.sheet(), deploying.sheet);
  return member_of(spare_diagonals(values.sheet(), rigid, *deploying.from_deg),
                   &SpareDiagonals::amount);
}

Value shape_rms(GoalValues& values) {
  const auto off = values.options().shape->fitted(values.sheet());
  return off ? Value(-off->rms_mm()) : std::nullopt;
}

Value shape_max(GoalValues& values) {
  const auto off = values.options().shape->fitted(values.sheet());
  return off ? Value(-off->max_mm()) : std::nullopt;
}

struct Functions {
  std::string_view name;
  Value (*value)(GoalValues& values);
  std::vector<GoalTerm> (*linearization)(SheetChanges& changes);
};

constexpr Functions kFunctions[] = {
    {"critical_friction_n_mm_per_mm", critical_friction, local_critical_friction},
    {"bent_critical_friction_n_mm_per_mm", bent_critical_friction, local_bent_critical_friction},
    {"static_friction_n_mm_per_mm", static_friction, local_static_friction},
    {"chosen_friction_n_mm_per_mm", chosen_friction, local_chosen_friction},
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

const StudyResult<BentPanels>& GoalValues::bent() {
  if (!bent_) bent_ = bend_panels(sheet_, options_.deploying, options_.bending);
  return *bent_;
}

Value GoalValues::value(const Goal& goal) {
  assert(options_.shape || !goal.needs_target);
  return functions_of(goal).value(*this);
}

Value value_of(const Goal& goal, const Sheet& sheet, const OptimiseOptions& options) {
  return GoalValues(sheet, options).value(goal);
}

std::vector<GoalTerm> linearization_of(const Goal& goal, SheetChanges& changes) {
  return functions_of(goal).linearization(changes);
}

}  // namespace misalign::solver
