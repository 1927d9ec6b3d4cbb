// The rejection tests' rules: what an expansion and a few converged states of a sheet say about its
// verdict. They only ever reject, and only what every sample's own test would reject too: samples
// are a subset of those that the verdict looks at, and every comparison leaves room for the error
// of both sides.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/model/rejection.hpp"
#include "solver/model/rejection_tolerances.hpp"

namespace misalign::solver {

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
