// An option that does not fit what is asked of a sheet, as data: borders say it in their own words.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

namespace misalign::solver {

struct OptionFault {
  std::string name;                  ///< of the parameter, its unit last: "from_deg"
  std::optional<std::string> value;  ///< as it is shown; none of a flag
  std::string why;                   ///< it does not fit, a clause
  std::string suggestion;            ///< what to try instead
};

/// A number in a fault's sentence: by a format of printf.
inline std::string shown(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace misalign::solver
