// A study of tolerance, as text.
#pragma once

#include <string>
#include <vector>

#include "solver/play/miscut_gap.hpp"
#include "solver/play/tolerance.hpp"

namespace misalign::search {

/// A sheet's name, "draw 17", and what was found of it.
struct NamedTolerance {
  std::string name;
  solver::Tolerance tolerance;
};

/// Of one sheet; what counts comes last.
std::string tolerance_text(const NamedTolerance& named);
/// A line for each of several, the one that copies survive best last.
std::string tolerances_text(std::vector<NamedTolerance> several);

/// The play that half of the copies need, and nearly all, then a line an angle.
std::string miscut_gap_text(const std::string& name, const solver::MiscutGap& gap);

}  // namespace misalign::search
