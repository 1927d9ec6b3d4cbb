// Bounds of the rejection tests and their places.
#pragma once

#include <cmath>

namespace misalign::solver {

/// Error bounds, and limits beyond which no result is used. They are not for users.
struct RejectionTolerances {
  /// Errors of a converged state: of a diagonal (1e-13 was seen) and of its slope.
  double path_length_widths = 1e-10;
  double path_slope_widths_per_rad = 1e-5;
  /// A slope counts if it moves the diagonal by more than this in one degree. A diagonal that
  /// reversed twice within two degrees, about a sample, had at most 2.4e-6 (two million sheets, at
  /// thresholds of every tenth degree and at their own; `bench --rejections`).
  double least_slope_widths_per_deg = 1e-5;
  /// Largest distance of samples at which slopes count: they only tell of close samples.
  double longest_sample_for_slopes_deg = 2;
  /// Least distance of slopes below the threshold: with a fold limit 0.3 degrees beyond it a
  /// diagonal reversed twice about the last sample at 1.9e-5 (draw 39533 of miura-narrow-6x6).
  double slopes_before_threshold_deg = 2;
  /// A fold limit at least this far below the threshold is certain.
  double certain_limit_deg = 0.4;
  /// A pilot has certainly turned back if its rate is below minus this multiple of the slope error.
  /// A tangent's error enters slopes (of a panel width per radian) and the rate: by at most 1.9
  /// slope errors in the two sheets where it was seen (8 x 6, shifts of 8 mm, single precision).
  double certain_turn_slope_errors = 10;
  /// Bound of the error of fold angles of a converged state, which is far smaller.
  double fold_angle_rad = 1e-8;
  /// The largest ratio of the second correction to the first: beyond it the state is not used (2 of
  /// 1,000 sheets at 150 degrees).
  double largest_ratio = 0.25;
  /// Safety factor of the constant K, which follows from the corrections, and of rounding in a
  /// diagonal, which is found on the base folding (at most 0.2 of it was seen).
  double safety = 10;
  /// Safety factor of a slope's remaining error, in corrections: the estimate that corrects it has
  /// the base folding's weights. Beyond the floors at most 1.9 was seen in double precision, 4.0 in
  /// single, in 150,000 cases.
  double slope_safety = 5;
  /// Bounds, with room, of a crease's turn (sine of its half) and of all corrections for paths that
  /// stay on their curve: over two thirds of the way to 150 degrees, and in steps of 5 degrees
  /// beyond it.
  double longest_half_sine = 0.5, longest_correction_rad = 0.15;
  /// The share of the pilot's angle by which a crease may turn while the shifts grow by a step.
  /// Sheets that reached another branch than with 128 steps turned by 0.19 or more in one of 8
  /// steps, by 0.3 in one of 12 to 32 (of 32,000 sheets of 8 x 6 at 6 and 8 mm). Four of five
  /// sheets stay below in 8 steps, nearly all in 32.
  double longest_growth_share = 0.1;
};
inline constexpr RejectionTolerances kRejection;

/// The last sample whose slopes count.
inline int last_sample_of_slopes(int threshold_sample, double sample_deg) {
  return threshold_sample -
         static_cast<int>(std::ceil(kRejection.slopes_before_threshold_deg / sample_deg - 1e-9));
}

}  // namespace misalign::solver
