// Whether the holes of a pattern leave its sheet one way to fold.
#pragma once

#include <string>

#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

/// Which perforations are no fault.
enum class Perforations {
  of_one_freedom,  ///< whatever the shifts
  /// Also those with too many constraints, where the shifts keep to the base's parallel family: the
  /// sheet folds in one way all the same.
  of_one_path,
  any
};

/// Whether it has more equations than unknowns, by fewer holes than count to one degree of freedom:
/// only members of its parallel family fold.
bool has_spare_equations(const solver::PerforatedSheet& base);

/// Adds a fault at `where` if they leave another number of degrees of freedom than one; the
/// pattern's shifts matter where there are too many constraints.
void check_perforation(const std::string& where, const Pattern& pattern, Perforations perforations,
                       InputFaults& faults);

}  // namespace misalign::schema
