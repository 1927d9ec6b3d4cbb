// Every method of the study: one entry, one curve.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/work_precision/problem.hpp"

namespace misalign::bench {

/// Makes a method ready: its workspace for this problem.
using Prepare = std::function<Run(const Problem&, const Demand&)>;

struct Method {
  std::string name;
  std::string linear_solver, precision, jacobian, predictor;
  double step_deg;  ///< 0: as long as it holds
  std::vector<int> spacings_deg;
  double least_tolerance;  ///< below it rounding alone leaves more
  Prepare prepare;
};

std::vector<Method> all_methods();

}  // namespace misalign::bench
