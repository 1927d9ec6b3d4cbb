// The answer of rejection tests about a sheet.
#pragma once

#include "solver/verdict/fault.hpp"

namespace misalign::solver {

struct Rejection {
  Fault fault = Fault::none;  ///< none: not decided, the full path must tell
  int sample = 0;             ///< where the test looked
};

}  // namespace misalign::solver
