// Exit codes for causes and options for parameters, on the command line.
#pragma once

#include "search/terminal/failure.hpp"

namespace misalign::search {

/// The exit codes of the contract; 0 if all is done.
constexpr int exit_code_of(schema::Cause cause) {
  switch (cause) {
    case schema::Cause::bad_request:
      return 2;
    case schema::Cause::bad_input:
      return 3;
    case schema::Cause::in_use:
      return 4;
    case schema::Cause::foreign:
      return 5;
    case schema::Cause::check_failed:
      return 6;
    case schema::Cause::failure:
      break;
  }
  return 1;
}
inline constexpr int kExitWorkRemains = 75;

/// Makes the option of a parameter's name: "--from " of "from_deg".
std::string option_of(std::string_view parameter, bool has_value);

inline constexpr Border kCommandLine{option_of, exit_code_of};

}  // namespace misalign::search
