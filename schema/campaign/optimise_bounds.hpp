// The names of what sheets are optimised for, and limits on it as people write them:
// "stroke_max <= 0.06", "miscut_margin_mm >= 0.1".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/optimise/goal.hpp"

namespace misalign::schema {

/// The names of goals, which are those of functions (schema/catalogue/study_table) or of a metric.
struct GoalName {
  std::string_view name;
  solver::OptimiseGoal goal;
  const char* words;
  /// Whether its numbers are written out here, and not a library's, which differ from machine to
  /// machine.
  bool is_same_everywhere;
  /// Whether it depends on the angle from which the sheet is let go.
  bool is_of_use;
  /// As keys end, and as people say it.
  const char* unit = "n_mm_per_mm";
  const char* unit_words = "N mm per mm";
};
inline constexpr GoalName kGoalNames[] = {
    {"critical_friction_n_mm_per_mm", solver::OptimiseGoal::critical_friction,
     "critical friction, panels rigid", true, true},
    {"bent_critical_friction_n_mm_per_mm", solver::OptimiseGoal::bent_critical_friction,
     "critical friction, panels bent", false, true},
    {"static_friction_n_mm_per_mm", solver::OptimiseGoal::static_friction,
     "static friction, panels bent", false, true},
    {"miscut_margin_mm", solver::OptimiseGoal::miscut_margin, "margin against miscuts", true, false,
     "mm", "mm"},
    {"energy_n_mm", solver::OptimiseGoal::energy, "energy of the springs", true, true, "n_mm",
     "N mm"},
    {"deploys_from_deg", solver::OptimiseGoal::deploys_from, "angle from which it deploys", false,
     false, "deg", "deg"},
    {"rest_stiffness_n_mm_per_rad", solver::OptimiseGoal::rest_stiffness,
     "stiffness where its springs rest, panels bent", false, false, "n_mm_per_rad", "N mm per rad"},
    {"thickness_mm", solver::OptimiseGoal::thickness, "thickness of its plates", false, false, "mm",
     "mm"},
    {"yield", solver::OptimiseGoal::yield, "share of miscut copies that deploy", false, false,
     "share", "of 1"},
    {"spare_diagonals", solver::OptimiseGoal::spare_diagonals, "diagonals that need no spring",
     false, true, "diagonals", "diagonals"}};
const GoalName& name_of(solver::OptimiseGoal goal);
/// Null where none has this name.
const GoalName* goal_named(std::string_view name);
std::vector<std::string> goal_names();

struct OptimiseBounds {
  std::optional<double> stroke_max, largest_force_n;  ///< at most
  std::vector<solver::OptimiseFloor> floors;  ///< at least; of each goal one, in their order

  bool operator==(const OptimiseBounds&) const = default;
};

/// Adds one; otherwise why not, and what to do.
struct BoundFault {
  std::string why, suggestion;
};
std::optional<BoundFault> add_bound(const std::string& text, OptimiseBounds& bounds);

/// As they are read, the upper ones first.
Json bounds_json(const OptimiseBounds& bounds);

}  // namespace misalign::schema
