// Bounds the angles at which chosen springs have to drive a sheet.
#pragma once

#include <optional>

#include "solver/sheet/sheet.hpp"
#include "solver/studies/option_fault.hpp"

namespace misalign::solver {

/// Returns the angle of use of a choice: `from_deg`, otherwise D, or the end of the path of a sheet
/// whose D is no larger than `to_deg`; at most the end of its way.
double driven_from_deg(const Sheet& sheet, const FoldingWay& way,
                       const std::optional<double>& from_deg, double to_deg);

/// Fault (from_deg): beyond the way, or not above `to_deg`.
std::optional<OptionFault> driven_range_fault(const Sheet& sheet, const FoldingWay& way,
                                              const std::optional<double>& from_deg, double to_deg);

}  // namespace misalign::solver
