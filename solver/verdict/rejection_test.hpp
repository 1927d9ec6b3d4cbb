// The rejection tests' rules: what a few converged states of a sheet say about its verdict. They
// only ever reject, and only what every sample's own test would reject too: samples are a subset of
// those that the verdict looks at, and every comparison leaves room for the error of both sides.
#pragma once

#include <optional>
#include <vector>

#include "solver/verdict/model.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// Errors of a converged state: of a diagonal (panel widths; 1e-13 was seen) and of its change per
/// radian of pilot.
inline constexpr double kPathLengthError = 1e-10;
inline constexpr double kPathSlopeError = 1e-5;

/// How well a fold limit on the approach to the threshold is known; four times as much is asked
/// for.
inline constexpr double kApproachTurn_deg = 0.1;

/// What became of one sheet.
struct Rejection {
  Fault fault = Fault::none;  ///< none: not decided, the full path must tell
  int sample = 0;             ///< where the test looked
};

/// One state of a sheet at a sample, its diagonals in panel widths and per radian of pilot.
struct Observation {
  int sample;
  const double* lengths;
  double length_error;
  const double* slopes;  ///< null: not known
  double slope_error;
};

/// How far a diagonal is from that of the solution (panel widths) after two corrections of these
/// sizes (rad); none where they do not shrink fast enough for that to be believed. Both by Newton:
/// each squares the error, e' = K e^2, and the corrections give K (Kantorovich).
std::optional<double> newton_error(double first_correction_rad, double second_correction_rad,
                                   double length_per_rad);
/// Both by the same factors: each shrinks the error by the same ratio.
std::optional<double> chord_error(double first_correction_rad, double second_correction_rad,
                                  double length_per_rad);
/// What rounding may leave in a diagonal (panel widths) at a test's angle, for numbers that differ
/// by `epsilon` next to 1: a loop closes to a few roundings of the sheet's extent.
double rounding_error(double epsilon, double extent, const TestAngle& test);
/// Error of slopes that were corrected by at most this much: kSlopeSafety times that, and a floor.
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
  /// Rejects the sheet if a diagonal was seen both growing and shrinking. Observations of one sheet
  /// at equal samples are taken as one.
  void observe(int sheet, const Observation& observation);
  /// Rejects it if a crease is over-folded or lost its sign in this state of its path.
  void observe(int sheet, int sample, const FoldState<double>& state);
  /// Rejects it if its path ended, by a fold limit short of the threshold.
  void path_ended(int sheet, const PathResult& path);

  const std::vector<Rejection>& results() const { return rejections_; }
  bool decided(int sheet) const { return rejections_[sheet].fault != Fault::none; }

 private:
  bool sees_both(int sheet, const Observation& observation);

  const Model& model_;
  const std::size_t diagonals_;
  std::vector<Rejection> rejections_;
  std::vector<double> flat_, earlier_;  // per sheet and diagonal
  std::vector<int> earlier_sample_;     // per sheet; 0: nothing seen yet
  std::vector<double> earlier_error_;   // per sheet
  std::vector<signed char> direction_;  // per sheet and diagonal; 0: not seen to move
};

}  // namespace misalign::solver
