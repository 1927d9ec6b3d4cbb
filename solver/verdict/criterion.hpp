// The criterion of a campaign besides diagonals that go one way at the samples.
#pragma once

#include <vector>

#include "solver/verdict/between.hpp"

namespace misalign::solver {

/// Springs of stiffness k on all diagonals, relaxed at one pilot angle, store k/2 sum (L - L0)^2,
/// whose second derivative with the pilot angle is k times this there: the sum of squares of the
/// diagonals' slopes (panel widths^2 per radian^2 for panel widths per radian).
inline double stop_stiffness(const std::vector<double>& slopes) {
  double sum = 0;
  for (const double slope : slopes) sum += slope * slope;
  return sum;
}

struct Criterion {
  BumpRule bumps = BumpRule::ignored;
  /// Where the sheet is to stop on the way, and how stiff the stop is to be at least (panel
  /// widths^2 per radian^2); sample 0: nowhere.
  int stop_sample = 0;
  double least_stop_stiffness = 0;
  /// Whether verdicts say besides how near the first fault was to not being one, see score.hpp.
  bool scores = false;

  bool asks_for_stop() const { return stop_sample > 0; }
  /// Whether this sample is where the sheet is to stop, and with these slopes would do so too
  /// softly.
  bool finds_soft_stop(int sample, const std::vector<double>& slopes) const {
    return asks_for_stop() && sample == stop_sample && stop_part(slopes) < 1;
  }
  /// The stop's stiffness as a share of the least.
  double stop_part(const std::vector<double>& slopes) const {
    return stop_stiffness(slopes) / least_stop_stiffness;
  }
};

}  // namespace misalign::solver
