# Writes what this build was made from into OUTPUT; see search/terminal/build_info.hpp.
execute_process(COMMAND git -C "${ROOT}" describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
string(STRIP "${FLAGS}" flags)
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [=[
#include "search/terminal/build_info.hpp"

namespace misalign::search {

const BuildInfo& build_info() {
  static const BuildInfo info = {"@VERSION@", "@commit@", "@COMPILER@", "@flags@"};
  return info;
}

}  // namespace misalign::search
]=])
