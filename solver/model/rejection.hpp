// Result of the rejection tests for a sheet.
#pragma once

#include "solver/verdict/fault.hpp"

namespace misalign::solver {

struct Rejection {
  Fault fault = Fault::none;  ///< none: undecided, the full path is needed
  int sample = 0;             ///< sample at which the test was made
};

}  // namespace misalign::solver
