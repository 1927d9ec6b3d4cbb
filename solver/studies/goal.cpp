#include "solver/studies/goal.hpp"

#include <algorithm>
#include <iterator>

namespace misalign::solver {
namespace {

constexpr char kNotThere[] = "the sheet that it starts from does not fold to the target's angle";

constexpr char kNotBent[] = "the panels of the sheet that it starts from cannot be bent";

constexpr Goal kGoals[] = {
    {.name = "critical_friction_n_mm_per_mm",
     .words = "critical friction, panels rigid",
     .is_same_everywhere = true,
     .is_of_use = true},
    {.name = "bent_critical_friction_n_mm_per_mm",
     .words = "critical friction, panels bent",
     .is_of_use = true},
    {.name = "static_friction_n_mm_per_mm",
     .words = "static friction, panels bent",
     .is_of_use = true},
    {.name = "chosen_friction_n_mm_per_mm",
     .words = "static friction of chosen springs, panels rigid",
     .is_same_everywhere = true,
     .is_of_use = true,
     .chooses_springs = true,
     .infeasible = "no springs of these rates drive the sheet that it starts from to flat"},
    {.name = "miscut_margin_mm",
     .words = "margin against miscuts",
     .unit = "mm",
     .unit_words = "mm",
     .is_same_everywhere = true,
     .needs_threshold = true,
     .infeasible = "no margin against miscuts is known of the sheet that it starts from"},
    {.name = "energy_n_mm",
     .words = "energy of the springs",
     .unit = "n_mm",
     .unit_words = "N mm",
     .is_same_everywhere = true,
     .is_of_use = true},
    {.name = "deploys_from_deg",
     .words = "angle from which it deploys",
     .unit = "deg",
     .unit_words = "deg",
     .is_exact = false,
     .is_proven_angle = true,
     .largest = 180},
    {.name = "rest_stiffness_n_mm_per_rad",
     .words = "stiffness where its springs rest, panels bent",
     .unit = "n_mm_per_rad",
     .unit_words = "N mm per rad",
     .infeasible = "the sheet that it starts from is not stiff where its springs rest, or they "
                   "rest beyond its end",
     .suggestion = "name a preload for flat, or an angle at which they rest for a stop"},
    {.name = "thickness_mm",
     .words = "thickness of its plates",
     .unit = "mm",
     .unit_words = "mm",
     .infeasible = "panels of the sheet that it starts from meet on the way"},
    {.name = "largest_stress_mpa",
     .words = "largest static stress of its panels",
     .unit = "mpa",
     .unit_words = "MPa",
     .is_of_use = true,
     .is_to_be_small = true,
     .largest = 0,
     .infeasible = kNotBent},
    {.name = "buckling_factor",
     .words = "buckling factor of its panels",
     .unit = "factor",
     .unit_words = "times the forces",
     .is_of_use = true,
     .infeasible = kNotBent},
    {.name = "spring_clearance_mm",
     .words = "clearance of its springs",
     .unit = "mm",
     .unit_words = "mm",
     .is_exact = false,
     .has_any_sign = true,
     .infeasible = "the springs of the sheet that it starts from are no bodies",
     .suggestion = "give the design springs with a \"diameter_mm\""},
    {.name = "yield",
     .words = "share of miscut copies that deploy",
     .unit = "share",
     .unit_words = "of 1",
     .is_exact = false,
     .needs_threshold = true,
     .needs_copies = true,
     .largest = 1,
     .infeasible = "no miscut copy of the sheet that it starts from deploys from there"},
    {.name = "spare_diagonals",
     .words = "diagonals that need no spring",
     .unit = "diagonals",
     .unit_words = "diagonals",
     .is_exact = false,
     .is_of_use = true},
    {.name = "shape_rms_mm",
     .words = "root mean square of the distances from the target",
     .unit = "mm",
     .unit_words = "mm",
     .is_to_be_small = true,
     .needs_target = true,
     .largest = 0,
     .infeasible = kNotThere},
    {.name = "shape_max_mm",
     .words = "largest distance from the target",
     .unit = "mm",
     .unit_words = "mm",
     .is_to_be_small = true,
     .needs_target = true,
     .largest = 0,
     .infeasible = kNotThere}};

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
