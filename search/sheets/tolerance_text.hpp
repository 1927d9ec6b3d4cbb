// A study of tolerance, as text.
#pragma once

#include <string>
#include <vector>

#include "solver/play/miscut_gap.hpp"
#include "solver/play/tolerance.hpp"

namespace misalign::search {

/// A sheet's name, "draw 17", and its tolerance.
struct NamedTolerance {
  std::string name;
  solver::Tolerance tolerance;
};

/// Text of one sheet; the result comes last.
std::string tolerance_text(const NamedTolerance& named);
/// A line for each of several, the one that copies survive best last.
std::string tolerances_text(std::vector<NamedTolerance> several);

/// Median and 95 % quantile of the joint gaps, then a line an angle.
std::string miscut_gap_text(const std::string& name, const solver::MiscutGap& gap);

}  // namespace misalign::search
