// An option that does not fit, as data: borders say it in their own words.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

namespace misalign::solver {

struct OptionFault {
  std::string name;                  ///< parameter's name, its unit last: "from_deg"
  std::optional<std::string> value;  ///< shown value; a flag has none
  std::string why;                   ///< reason, a clause
  std::string suggestion;            ///< remedy
};

/// Writes a number in a fault's sentence, by a format of printf.
inline std::string shown(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace misalign::solver
