// Sheets to begin with that are used from 150 degrees.
#pragma once

#include "tests/solver/optimise/optimising.hpp"

namespace misalign::solver {

class Goals : public Optimising {
 protected:
  Goals() { options_.used_from_deg = 150; }

  Eigen::Matrix2Xd next_start() { return Optimising::next_start(false); }
  Springs& springs() { return options_.deploying.sheet.springs(); }
};

}  // namespace misalign::solver
