// A study of miscut copies, in words and as JSON.
#pragma once

#include <string>

#include "search/sheets/tolerance.hpp"

namespace misalign::search {

/// A sheet's name, "draw 17", and what was found of it.
struct NamedTolerance {
  std::string name;
  Tolerance tolerance;
};

/// Of one sheet; what counts comes last.
std::string tolerance_text(const NamedTolerance& named);
/// A line for each of several, the one that copies survive best last.
std::string tolerances_text(std::vector<NamedTolerance> several);
/// Without the sheet's name.
schema::Json tolerance_json(const Tolerance& tolerance);

}  // namespace misalign::search
