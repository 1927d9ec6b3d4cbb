// The rejection tests' rules: what an expansion and a few converged states of a sheet say about its
// verdict. They only ever reject, and only what every sample's own test would reject too: samples
// are a subset of those that the verdict looks at, and every comparison leaves room for the error
// of both sides.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// What is left for errors, and when nothing is believed. Not for users: these are bounds.
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
  /// How far below the threshold a fold limit must lie to be certain.
  double certain_limit_deg = 0.4;
  /// A pilot has turned back for certain where its rate is so many slope errors: a tangent that
  /// spoils slopes (of a panel width in a radian) spoils the rate too, by 1.9 of them at most in
  /// the two sheets in which that was seen (8 x 6, shifts of 8 mm, single precision).
  double certain_turn_slope_errors = 10;
  /// Fold angles of a converged state are better than this by far.
  double fold_angle_rad = 1e-8;
  /// Of the second correction to the first: beyond it, nothing is believed (2 of 1,000 sheets at
  /// 150 degrees).
  double largest_ratio = 0.25;
  /// Room for the constant K, which is found from the corrections, and for how much of a rounding
  /// shows in a diagonal, which is found on the base folding (0.2 of it at most was seen).
  double safety = 10;
  /// The same for what is left of a slope's error, in corrections: the estimate that corrects it
  /// has the base folding's weights. Beside the floors 1.9 were seen in double precision, 4.0 in
  /// single, in 150,000 cases.
  double slope_safety = 5;
  /// What two thirds of the way to 150 degrees, and steps of 5 degrees beyond it, move the creases
  /// of paths that stay on their curve, with room: sine of half of a turn, and all corrections.
  double longest_half_sine = 0.5, longest_correction_rad = 0.15;
  /// Of the pilot's angle, what a crease may turn by while the shifts grow by a step. What got to
  /// another branch than by 128 steps turned by 0.19 or more in one of 8, by 0.3 in one of 12 to 32
  /// (of 32,000 sheets of 8 x 6 at 6 and 8 mm); four of five sheets do not in 8, nearly all in 32.
  double longest_growth_share = 0.1;
};
inline constexpr RejectionTolerances kRejection;

/// The last sample whose slopes count.
inline int last_sample_of_slopes(int threshold_sample, double sample_deg) {
  return threshold_sample -
         static_cast<int>(std::ceil(kRejection.slopes_before_threshold_deg / sample_deg - 1e-9));
}

/// What became of one sheet.
struct Rejection {
  Fault fault = Fault::none;  ///< none: not decided, the full path must tell
  int sample = 0;             ///< where the test looked
};

/// One state of a sheet, its diagonals in panel widths and per radian of the way along its path.
struct Observation {
  double pilot_deg;
  int sample;           ///< that it is at exactly; 0: at none
  double pilot_rate;    ///< how the pilot changes along that way; not positive: it turned back
  double farthest_deg;  ///< no farther had the pilot been on the way here
  const double* lengths;
  double length_error;
  const double* slopes;
  double slope_error;
};

/// How far a diagonal is from that of the solution (panel widths) after two corrections of these
/// sizes (rad); none where they do not shrink fast enough for that to be believed. Both by Newton:
/// each squares the error, e' = K e^2, and the corrections give K (Kantorovich).
std::optional<double> newton_error(double first_correction_rad, double second_correction_rad,
                                   double length_per_rad);
/// What rounding may leave in a diagonal (panel widths) at a test's angle, for numbers that differ
/// by `epsilon` next to 1: a loop closes to a few roundings of the sheet's extent.
double rounding_error(double epsilon, double extent, const TestPlace& test);
/// How far to go along a path from a state with this pilot angle (degrees of the base folding's
/// pilot); sheets depart from the base folding at `far_deg`.
double step_ahead_deg(double pilot_deg, double far_deg);
/// Steps that lose the way are halved, down to this one.
inline constexpr double kShortestStep_deg = 0.5, kLongestStep_deg = 7.5;
/// How far a pilot gets between two states `step` apart on a path (deg), where it changes at these
/// rates: where the path's tangents meet, and half as much again.
double farthest_between(double from_deg, double from_rate, double to_deg, double to_rate,
                        double step);
/// Of a vector.
double norm_of(const std::vector<double>& vector);
/// Error of slopes that were corrected by at most this much: so many times that, and a floor.
double slope_error(double correction);

/// The memory of a block of sheets while they are tested.
class RejectionTest {
 public:
  explicit RejectionTest(const Model& model);
  ~RejectionTest();

  /// Forgets everything; room for `sheets` of them.
  void begin(int sheets);
  /// The sheet's flat diagonals, before anything else about it.
  void set_flat(int sheet, const double* lengths);
  /// What is certain of a sheet's diagonals at samples up to this one, before anything else: 1, it
  /// grows somewhere, -1, it shrinks. Rejects the sheet if one does both.
  void expect(int sheet, const signed char* directions, bool both, int sample);
  /// Rejects the sheet if a diagonal was seen both growing and shrinking, or if its pilot has
  /// turned back short of the threshold. True if it is not decided and states beyond may tell more.
  bool observe(int sheet, const Observation& observation);
  /// Rejects it if a crease is over-folded or lost its sign in this state of its path, short of the
  /// threshold.
  void observe(int sheet, double pilot_deg, const FoldState<double>& state);

  /// Beyond, of slopes nothing is believed.
  double slopes_until_deg() const { return slopes_until_deg_; }
  /// The next sample beyond this pilot angle that is worth a look exactly there, where slopes are
  /// not enough: the last one whose slopes count, and each after it.
  int next_sample(double pilot_deg) const;
  const std::vector<Rejection>& results() const { return rejections_; }
  bool decided(int sheet) const { return rejections_[sheet].fault != Fault::none; }

 private:
  bool sees_both(int sheet, const Observation& observation);

  const Model& model_;
  /// The first sample that is not before it.
  int sample_of(double pilot_deg) const {
    return static_cast<int>(std::ceil(pilot_deg / model_.sample_deg() * (1 - 1e-12)));
  }

  const std::size_t diagonals_;
  const double threshold_deg_, slopes_until_deg_;
  std::vector<Rejection> rejections_;
  std::vector<double> flat_, earlier_;  // per sheet and diagonal
  std::vector<double> earlier_deg_;     // per sheet: pilot; 0: nothing seen yet
  std::vector<char> earlier_exact_;     // per sheet: whether that is a sample's
  std::vector<double> earlier_error_;   // per sheet
  std::vector<signed char> direction_;  // per sheet and diagonal; 0: not seen to move
};

}  // namespace misalign::solver
