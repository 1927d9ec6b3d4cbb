// Defines a campaign's criterion beyond diagonals that are monotone at the samples.
#pragma once

#include <vector>

#include "solver/verdict/between.hpp"

namespace misalign::solver {

/// Springs of stiffness k on all diagonals, relaxed at one pilot angle, store k/2 sum (L - L0)^2.
/// Its second derivative by the pilot angle is k times this sum of squares of the diagonals' slopes
/// (panel widths^2 per radian^2 for panel widths per radian).
inline double stop_stiffness(const std::vector<double>& slopes) {
  double sum = 0;
  for (const double slope : slopes) sum += slope * slope;
  return sum;
}

struct Criterion {
  BumpRule bumps = BumpRule::ignored;
  /// Sample at which the sheet is to stop (0: none), and least stiffness of the stop (panel
  /// widths^2 per radian^2).
  int stop_sample = 0;
  double least_stop_stiffness = 0;
  /// True if verdicts have a score (score.hpp).
  bool scores = false;

  bool asks_for_stop() const { return stop_sample > 0; }
  /// Returns whether the sheet is to stop at this sample and the stop is too soft with these
  /// slopes.
  bool finds_soft_stop(int sample, const std::vector<double>& slopes) const {
    return asks_for_stop() && sample == stop_sample && stop_part(slopes) < 1;
  }
  /// The stop's stiffness divided by the least.
  double stop_part(const std::vector<double>& slopes) const {
    return stop_stiffness(slopes) / least_stop_stiffness;
  }
};

}  // namespace misalign::solver
