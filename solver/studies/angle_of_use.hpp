// Angle of use: the pilot angle from which a sheet is used. All requirements hold between it and
// flat.
#pragma once

#include <algorithm>
#include <cassert>
#include <optional>

#include "solver/continuation/path.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/studies/option_fault.hpp"

namespace misalign::solver {

/// Returns the angle of use in degrees: `from_deg`, at most D; none: D.
inline double angle_of_use(const Sheet& sheet, const std::optional<double>& from_deg) {
  const double d_deg = sheet.deploys_from_deg();
  return std::min(from_deg.value_or(d_deg), d_deg);
}

/// Number of the history's rows up to the angle of use, of which the history must have a station.
inline Eigen::Index rows_of_use(const Sheet& sheet, const std::optional<double>& from_deg) {
  if (!from_deg || *from_deg >= sheet.deploys_from_deg()) return sheet.rows_up_to_d();
  const std::optional<Eigen::Index> row = sheet.row_at(*from_deg);
  assert(row);
  return *row + 1;
}

/// Fault of an angle of use beyond D.
inline OptionFault beyond_d_fault(const std::string& name, double from_deg, double d_deg) {
  if (!(d_deg > 0)) {
    return OptionFault{"from_deg", shown("%.10g", from_deg), name + " does not deploy (D = 0)",
                       "take a sheet that deploys"};
  }
  return OptionFault{
      "from_deg", shown("%.10g", from_deg),
      "lies beyond D = " + shown("%.10g", d_deg) + " deg, from which " + name + " deploys",
      "name D or a smaller angle"};
}

/// Fault (from_deg) of an angle of use that exceeds the sheet's D.
inline std::optional<OptionFault> beyond_d(const Sheet& sheet, double from_deg) {
  const double d_deg = sheet.deploys_from_deg();
  if (from_deg <= d_deg + kSameAngle_deg) return {};
  return beyond_d_fault(sheet.name(), from_deg, d_deg);
}

}  // namespace misalign::solver
