// An option that does not fit what is asked of a sheet, as data: borders say it in their own words.
#pragma once

#include <optional>
#include <string>

namespace misalign::solver {

struct OptionFault {
  std::string name;                  ///< of the parameter, its unit last: "from_deg"
  std::optional<std::string> value;  ///< as it is shown; none of a flag
  std::string why;                   ///< it does not fit, a clause
  std::string suggestion;            ///< what to try instead
};

}  // namespace misalign::solver
