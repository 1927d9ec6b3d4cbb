// Goals of an optimisation: objectives, and quantities with bounds. Their functions are in
// optimise/goal_functions, so that readers of campaigns need no study.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace misalign::solver {

/// A row of the one table of goals, which verbs, campaigns, Python and help read.
struct Goal {
  std::string_view name;  ///< name of a function (schema/catalogue/study_table) or a metric
  const char* words;
  /// Unit, as in the ends of keys and in words.
  const char *unit = "n_mm_per_mm", *unit_words = "N mm per mm";
  /// True if the least of the terms is the goal itself; otherwise they only lead to larger values.
  bool is_exact = true;
  /// True if no library takes part, whose numbers differ from machine to machine. Campaigns have
  /// these goals alone.
  bool is_same_everywhere = false;
  /// True if it depends on the angle of use.
  bool is_of_use = false;
  /// True if the sheet's model needs a threshold, and the options miscut copies.
  bool needs_threshold = false, needs_copies = false;
  /// True if it is an angle up to which the optimum must be proven.
  bool is_proven_angle = false;
  /// True if springs are chosen for each sheet: the optimum's are part of the result.
  bool chooses_springs = false;
  /// True if it is to be small: ascents have its negative, and floors that of an upper bound.
  bool is_to_be_small = false;
  /// True if its values have any sign.
  bool has_any_sign = false;
  /// True if it measures the shape of the sheet, and the options need a target.
  bool needs_target = false;
  double largest = std::numeric_limits<double>::infinity();
  /// Reason why a start has no value, and what to do.
  const char* infeasible = "nothing drives the sheet that it starts from to flat";
  const char* suggestion = "begin with another sheet, or with another goal";

  /// A value of an ascent, or a floor, as the quantity itself; and the reverse.
  double in_unit(double value) const { return is_to_be_small ? -value : value; }
  const char* relation() const { return is_to_be_small ? "<=" : ">="; }
};

/// Rows in the order of texts and of floors: the usual goal first.
std::span<const Goal> goal_table();
/// Returns null where no goal has this name.
const Goal* goal_named(std::string_view name);
/// The names of all goals, or of those that are so: &Goal::is_same_everywhere.
std::vector<std::string> goal_names(bool Goal::*is_so = nullptr);

/// Bound of another goal: the least, or of one that is to be small the largest value.
struct OptimiseFloor {
  const Goal* goal;
  double least;  ///< unit: the goal's; with the sign of Goal::in_unit

  bool operator==(const OptimiseFloor&) const = default;
};

}  // namespace misalign::solver
