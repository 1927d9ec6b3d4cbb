// A sheet that was made better, as JSON: its pattern, what it is worth, and what limits it.
#pragma once

#include "schema/exchange/folding_json.hpp"
#include "solver/design/optimise.hpp"

namespace misalign::schema {

/// The names of goals, which are those of functions (schema/catalogue/study_table) or of a metric.
struct GoalName {
  std::string_view name;
  solver::OptimiseGoal goal;
  const char* words;
  /// As keys end, and as people say it.
  const char* unit = "n_mm_per_mm";
  const char* unit_words = "N mm per mm";
};
inline constexpr GoalName kGoalNames[] = {
    {"critical_friction_n_mm_per_mm", solver::OptimiseGoal::critical_friction,
     "critical friction, panels rigid"},
    {"bent_critical_friction_n_mm_per_mm", solver::OptimiseGoal::bent_critical_friction,
     "critical friction, panels bent"},
    {"static_friction_n_mm_per_mm", solver::OptimiseGoal::static_friction,
     "static friction, panels bent"},
    {"miscut_margin_mm", solver::OptimiseGoal::miscut_margin, "margin against miscuts", "mm",
     "mm"}};
const GoalName& name_of(solver::OptimiseGoal goal);

/// `sheet`: the one that was found, proven up to `certified_deg`, and its pattern file.
Json optimise_json(const solver::Sheet& sheet, const solver::Optimised& found,
                   std::optional<double> certified_deg, const Json& pattern);

}  // namespace misalign::schema
