// Checks that the holes of a pattern leave its sheet one way to fold.
#pragma once

#include <string>

#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

/// Perforations without a fault.
enum class Perforations {
  of_one_freedom,  ///< any shifts
  /// Also overconstrained ones with shifts in the base's parallel family: the sheet folds in one
  /// way nevertheless.
  of_one_path,
  any
};

/// Returns whether a base is overconstrained, with fewer holes than one degree of freedom requires
/// by counting: only members of its parallel family fold.
bool is_overconstrained(const solver::PerforatedSheet& base);

/// Returns whether these shifts, at least one not zero, make a member of the parallel family of a
/// base that folds flat, on a path that must be followed: all its creases reach 180 degrees at
/// once, where rounding decides the first fault. Verdicts end at the sample before.
bool closes_at_180(const solver::PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm);

/// Adds a fault at `where` unless the holes leave one degree of freedom; the pattern's shifts
/// matter if it is overconstrained.
void check_perforation(const std::string& where, const Pattern& pattern, Perforations perforations,
                       InputFaults& faults);

}  // namespace misalign::schema
