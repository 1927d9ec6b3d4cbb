// The table of goals. To add one: its row below, its value as a function here, and its
// linearisation in local_goals.
#include <algorithm>

#include "solver/bending/preload.hpp"
#include "solver/bending/rest_stiffness.hpp"
#include "solver/contact/contact.hpp"
#include "solver/optimise/goal.hpp"
#include "solver/optimise/local_goals.hpp"
#include "solver/optimise/objective.hpp"
#include "solver/optimise/spare_diagonals.hpp"

namespace misalign::solver {
namespace {

using Value = std::optional<double>;

// A value of a study, where it found one.
template <class Study, class Member>
Value value_of(const std::optional<Study>& study, Member member) {
  return study ? Value((*study).*member) : std::nullopt;
}

Value critical_friction(const Sheet& sheet, const OptimiseOptions& options) {
  const auto rigid = standstill(sheet, options.deploying).study;
  return rigid ? rigid->friction.critical_n_mm_per_mm : std::nullopt;
}

// The friction that panels that bend leave; none where some angles are not sure.
std::optional<BentFriction> bent_friction(const Sheet& sheet, const OptimiseOptions& options) {
  const auto bent = bend_panels(sheet, options.deploying, options.bending).study;
  return bent && bent->unsure() == 0 ? std::optional(bent->friction) : std::nullopt;
}

Value bent_critical_friction(const Sheet& sheet, const OptimiseOptions& options) {
  const auto friction = bent_friction(sheet, options);
  return friction ? friction->critical_n_mm_per_mm : std::nullopt;
}

Value static_friction(const Sheet& sheet, const OptimiseOptions& options) {
  return value_of(bent_friction(sheet, options), &BentFriction::static_n_mm_per_mm);
}

Value miscut_margin(const Sheet& sheet, const OptimiseOptions&) {
  return sheet.record().miscut_margin_mm;
}

Value stored_energy(const Sheet& sheet, const OptimiseOptions& options) {
  return springs_n_mm(sheet, options.deploying);
}

Value deployed_angle(const Sheet& sheet, const OptimiseOptions&) { return goes_until_deg(sheet); }

Value stiffness_at_rest(const Sheet& sheet, const OptimiseOptions& options) {
  return value_of(rest_stiffness(sheet, options.deploying, options.bending.material),
                  &RestStiffness::n_mm_per_rad);
}

Value plate_thickness(const Sheet& sheet, const OptimiseOptions& options) {
  const auto found = contact(sheet, {{}, options.used_from_deg}).study;
  return found && found->thickness ? Value(found->thickness->thickness_mm) : std::nullopt;
}

Value share_of_copies(const Sheet& sheet, const OptimiseOptions& options) {
  return options.yield(sheet);
}

Value springs_spared(const Sheet& sheet, const OptimiseOptions& options) {
  const DeployOptions& deploying = options.deploying;
  const DeployingSheet rigid(*sheet.way(), sheet.model().shape(), sheet.base(), deploying.sheet);
  return value_of(spare_diagonals(sheet, rigid, *deploying.from_deg), &SpareDiagonals::amount);
}

constexpr Goal kGoals[] = {
    {.name = "critical_friction_n_mm_per_mm",
     .words = "critical friction, panels rigid",
     .value = critical_friction,
     .linearization = local_critical_friction,
     .is_same_everywhere = true,
     .is_of_use = true},
    {.name = "bent_critical_friction_n_mm_per_mm",
     .words = "critical friction, panels bent",
     .value = bent_critical_friction,
     .linearization = local_bent_critical_friction,
     .is_of_use = true},
    {.name = "static_friction_n_mm_per_mm",
     .words = "static friction, panels bent",
     .value = static_friction,
     .linearization = local_static_friction,
     .is_of_use = true},
    {.name = "miscut_margin_mm",
     .words = "margin against miscuts",
     .unit = "mm",
     .unit_words = "mm",
     .value = miscut_margin,
     .linearization = local_margin,
     .is_same_everywhere = true,
     .needs_threshold = true,
     .infeasible = "no margin against miscuts is known of the sheet that it starts from"},
    {.name = "energy_n_mm",
     .words = "energy of the springs",
     .unit = "n_mm",
     .unit_words = "N mm",
     .value = stored_energy,
     .linearization = local_energy,
     .is_same_everywhere = true,
     .is_of_use = true},
    {.name = "deploys_from_deg",
     .words = "angle from which it deploys",
     .unit = "deg",
     .unit_words = "deg",
     .value = deployed_angle,
     .linearization = local_deployed_angle,
     .is_exact = false,
     .is_proven_angle = true,
     .largest = 180},
    {.name = "rest_stiffness_n_mm_per_rad",
     .words = "stiffness where its springs rest, panels bent",
     .unit = "n_mm_per_rad",
     .unit_words = "N mm per rad",
     .value = stiffness_at_rest,
     .linearization = local_rest_stiffness,
     .infeasible = "the sheet that it starts from is not stiff where its springs rest, or they "
                   "rest beyond its end",
     .suggestion = "name a preload for flat, or an angle at which they rest for a stop"},
    {.name = "thickness_mm",
     .words = "thickness of its plates",
     .unit = "mm",
     .unit_words = "mm",
     .value = plate_thickness,
     .linearization = local_thickness,
     .infeasible = "panels of the sheet that it starts from meet on the way"},
    {.name = "yield",
     .words = "share of miscut copies that deploy",
     .unit = "share",
     .unit_words = "of 1",
     .value = share_of_copies,
     .linearization = local_margin,
     .is_exact = false,
     .needs_threshold = true,
     .needs_copies = true,
     .largest = 1,
     .infeasible = "no miscut copy of the sheet that it starts from deploys from there"},
    {.name = "spare_diagonals",
     .words = "diagonals that need no spring",
     .unit = "diagonals",
     .unit_words = "diagonals",
     .value = springs_spared,
     .linearization = local_spare_diagonals,
     .is_exact = false,
     .is_of_use = true}};

}  // namespace

std::span<const Goal> goal_table() { return kGoals; }

const Goal* goal_named(std::string_view name) {
  const auto* const goal = std::ranges::find(kGoals, name, &Goal::name);
  return goal == std::end(kGoals) ? nullptr : goal;
}

std::vector<std::string> goal_names(bool Goal::*is_so) {
  std::vector<std::string> names;
  for (const Goal& goal : kGoals) {
    if (!is_so || goal.*is_so) names.emplace_back(goal.name);
  }
  return names;
}

}  // namespace misalign::solver
