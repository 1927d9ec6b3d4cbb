// The goals of an optimisation: what it makes as large as can be, or keeps from being small. Their
// functions are in optimise/goal_functions: those who only read campaigns need no study.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace misalign::solver {

/// A row of the one table of goals, which verbs, campaigns, Python and help read.
struct Goal {
  std::string_view name;  ///< that of a function (schema/catalogue/study_table) or of a metric
  const char* words;
  /// The unit, as keys end and as people say it.
  const char *unit = "n_mm_per_mm", *unit_words = "N mm per mm";
  /// Whether the least of the pieces is the goal itself; otherwise they only lead to more of it.
  bool is_exact = true;
  /// Whether its numbers are written out here, and not a library's, which differ from machine to
  /// machine: campaigns have these goals alone.
  bool is_same_everywhere = false;
  /// Whether it depends on the angle from which the sheet is let go.
  bool is_of_use = false;
  /// Whether the sheet's model needs a threshold, and the options miscut copies.
  bool needs_threshold = false, needs_copies = false;
  /// Whether it is an angle, up to which the sheet at the end is to be proven.
  bool is_proven_angle = false;
  double largest = std::numeric_limits<double>::infinity();
  /// Why a start has none of it, and what to do.
  const char* infeasible = "nothing drives the sheet that it starts from to flat";
  const char* suggestion = "begin with another sheet, or with another goal";
};

/// The rows, in the order in which people are told of them and floors are kept: the usual one
/// first.
std::span<const Goal> goal_table();
/// Null where none has this name.
const Goal* goal_named(std::string_view name);
/// The names of all goals, or of those that are so: &Goal::is_same_everywhere.
std::vector<std::string> goal_names(bool Goal::*is_so = nullptr);

/// The least value of another goal.
struct OptimiseFloor {
  const Goal* goal;
  double least;  ///< in the goal's unit

  bool operator==(const OptimiseFloor&) const = default;
};

}  // namespace misalign::solver
