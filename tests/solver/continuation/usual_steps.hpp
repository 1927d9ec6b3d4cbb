// Close steps as tests of them alone have them, and the stations that they shall reach.
#pragma once

#include <vector>

#include "solver/continuation/close_steps.hpp"

namespace misalign::solver {

/// A station is believed as soon as it closes.
inline constexpr CloseSteps::Options kUsual = [] {
  CloseSteps::Options options;
  options.least_corrections = 0;
  return options;
}();

inline PathPlan stations_at(const std::vector<double>& angles_deg) {
  PathPlan plan;
  for (const double angle_deg : angles_deg) {
    plan.stations.push_back({angle_deg, half_angle_of_deg(angle_deg), 0, true});
  }
  return plan;
}

}  // namespace misalign::solver
