// The bounds that rejection tests and the places where they look keep to.
#pragma once

#include <cmath>

namespace misalign::solver {

/// Room for errors, and limits beyond which nothing is believed. Not for users: these are bounds.
struct RejectionTolerances {
  /// Errors of a converged state: of a diagonal (1e-13 was seen) and of its change.
  double path_length_widths = 1e-10;
  double path_slope_widths_per_rad = 1e-5;
  /// A slope counts when it carries the diagonal by more than this in one degree: a diagonal that
  /// turned round and back again within two degrees, about a sample, had 2.4e-6 at most (of two
  /// million sheets, at thresholds of every tenth degree and at their own; `bench --rejections`).
  double least_slope_widths_per_deg = 1e-5;
  /// Slopes speak of the samples next to theirs only if those are close.
  double longest_sample_for_slopes_deg = 2;
  /// And only so far below the threshold: a fold limit 0.3 degrees beyond it let a diagonal turn
  /// round and back again about the last sample at 1.9e-5 (draw 39533 of miura-narrow-6x6).
  double slopes_before_threshold_deg = 2;
  /// A fold limit at least this far below the threshold is certain.
  double certain_limit_deg = 0.4;
  /// A pilot has turned back for certain where its rate is so many slope errors: a tangent that
  /// spoils slopes (of a panel width in a radian) spoils the rate too, by 1.9 of them at most in
  /// the two sheets in which that was seen (8 x 6, shifts of 8 mm, single precision).
  double certain_turn_slope_errors = 10;
  /// Fold angles of a converged state are better than this by far.
  double fold_angle_rad = 1e-8;
  /// The largest ratio of the second correction to the first: beyond it, nothing is believed (2 of
  /// 1,000 sheets at 150 degrees).
  double largest_ratio = 0.25;
  /// Room for the constant K, which is found from the corrections, and for how much of a rounding
  /// shows in a diagonal, which is found on the base folding (0.2 of it at most was seen).
  double safety = 10;
  /// The same for what is left of a slope's error, in corrections: the estimate that corrects it
  /// has the base folding's weights. Beside the floors 1.9 were seen in double precision, 4.0 in
  /// single, in 150,000 cases.
  double slope_safety = 5;
  /// Creases of paths that stay on their curve are moved by no more than this on two thirds of the
  /// way to 150 degrees, and in steps of 5 degrees beyond it, with room: sine of half of a turn,
  /// and all corrections.
  double longest_half_sine = 0.5, longest_correction_rad = 0.15;
  /// The share of the pilot's angle by which a crease may turn while the shifts grow by a step.
  /// What got to another branch than by 128 steps turned by 0.19 or more in one of 8, by 0.3 in one
  /// of 12 to 32 (of 32,000 sheets of 8 x 6 at 6 and 8 mm); four of five sheets do not in 8, nearly
  /// all in 32.
  double longest_growth_share = 0.1;
};
inline constexpr RejectionTolerances kRejection;

/// The last sample whose slopes count.
inline int last_sample_of_slopes(int threshold_sample, double sample_deg) {
  return threshold_sample -
         static_cast<int>(std::ceil(kRejection.slopes_before_threshold_deg / sample_deg - 1e-9));
}

}  // namespace misalign::solver
