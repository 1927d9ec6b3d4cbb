// Whether the holes of a pattern leave its sheet one way to fold.
#pragma once

#include <string>

#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

/// Which perforations are no fault.
enum class Perforations {
  of_one_freedom,  ///< whatever the shifts
  /// Also overconstrained ones, where the shifts keep to the base's parallel family: the sheet
  /// folds in one way all the same.
  of_one_path,
  any
};

/// Whether it has more equations than unknowns, by fewer holes than count to one degree of freedom:
/// only members of its parallel family fold.
bool is_overconstrained(const solver::PerforatedSheet& base);

/// Whether these shifts, of which one is not zero, make a member of the parallel family of a base
/// that folds flat, on a path that has to be followed: all its creases come to 180 degrees at once,
/// where rounding decides what happens first. Verdicts end at the sample before.
bool closes_at_180(const solver::PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm);

/// Adds a fault at `where` if they leave another number of degrees of freedom than one; the
/// pattern's shifts matter where it is overconstrained.
void check_perforation(const std::string& where, const Pattern& pattern, Perforations perforations,
                       InputFaults& faults);

}  // namespace misalign::schema
