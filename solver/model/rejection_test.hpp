// Rejects sheets by rules on an expansion and a few converged states. Only sheets that the test of
// every sample would reject too are rejected: samples are a subset of the verdict's, and every
// comparison allows for the errors of both sides.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "solver/model/energy_rejection.hpp"
#include "solver/model/model.hpp"
#include "solver/model/rejection.hpp"
#include "solver/model/rejection_tolerances.hpp"

namespace misalign::solver {

/// Error of a diagonal (panel widths) after two Newton corrections of these sizes (rad); none if
/// they do not shrink fast enough. Each squares the error, e' = K e^2, and the corrections give K
/// (Kantorovich).
std::optional<double> newton_error(double first_correction_rad, double second_correction_rad,
                                   double length_per_rad);
/// Rounding error of a diagonal (panel widths) at a test's angle, for numbers with the machine
/// epsilon `epsilon`: a loop closes to a few roundings of the sheet's extent.
double rounding_error(double epsilon, double extent, const TestPlace& test);
/// Length of the next step along a path from a state with this pilot angle (degrees of the base
/// folding's pilot); sheets depart from the base folding at `far_deg`.
double step_ahead_deg(double pilot_deg, double far_deg);
/// Bounds of a step; those that lose the path are halved. Sharp fold limits take the shortest.
inline constexpr double kShortestStep_deg = 0.1, kLongestStep_deg = 7.5;
/// Largest pilot angle between two states `step` apart on a path (deg) with these rates: half as
/// far again as the point where the path's tangents meet.
double farthest_between(double from_deg, double from_rate, double to_deg, double to_rate,
                        double step);
/// Euclidean norm.
double norm_of(const std::vector<double>& vector);
/// Error of slopes after a largest correction `correction`: a multiple of it plus a floor.
double slope_error(double correction);

/// State of a block of sheets while they are tested.
class RejectionTest {
 public:
  using Observation = ObservedState;

  explicit RejectionTest(const Model& model);
  ~RejectionTest();

  /// Begins a block of `sheets` sheets.
  void begin(int sheets);
  /// Sets a sheet's flat diagonals, before all else.
  void set_flat(int sheet, const double* lengths);
  /// Sets the certain directions of a sheet's diagonals at samples up to `sample`, before any
  /// state: 1 if it grows somewhere, -1 if it shrinks. Rejects the sheet if one does both.
  void expect(int sheet, const signed char* directions, bool both, int sample);
  /// Rejects the sheet if a diagonal was seen both growing and shrinking, or under the energy
  /// criterion if the energy falls on the way from flat or a margin is missed, or if its pilot has
  /// turned back short of the threshold. Returns true if it is undecided and states beyond may
  /// decide.
  bool observe(int sheet, const Observation& observation);
  /// Rejects the sheet if a crease is over-folded or has the wrong sign in a state short of the
  /// threshold.
  void observe(int sheet, double pilot_deg, const FoldState<double>& state);

  /// Pilot angle beyond which slopes do not count.
  double slopes_until_deg() const { return slopes_until_deg_; }
  /// The next sample beyond this pilot angle to be solved exactly because slopes do not suffice:
  /// the last one whose slopes count, and each after it.
  int next_sample(double pilot_deg) const;
  /// Returns whether every step ahead that can ends at a sample.
  bool holds_every_step() const { return energy_ && energy_->judges(); }
  const std::vector<Rejection>& results() const { return rejections_; }
  bool decided(int sheet) const { return rejections_[sheet].fault != Fault::none; }

 private:
  Fault fault_of(int sheet, const Observation& observation);
  bool sees_both(int sheet, const Observation& observation);

  const Model& model_;
  /// The first sample at or beyond this pilot angle.
  int sample_of(double pilot_deg) const {
    return static_cast<int>(std::ceil(pilot_deg / model_.sample_deg() * (1 - 1e-12)));
  }

  const std::size_t diagonals_;
  const double threshold_deg_, slopes_until_deg_;
  std::vector<Rejection> rejections_;
  std::vector<double> flat_, earlier_;     // per sheet and diagonal
  std::vector<double> earlier_deg_;        // per sheet: pilot; 0: no state yet
  std::vector<char> earlier_exact_;        // per sheet: true if that is a sample
  std::vector<double> earlier_error_;      // per sheet
  std::vector<signed char> direction_;     // per sheet and diagonal; 0: no motion seen
  std::optional<EnergyRejection> energy_;  // under the energy criterion
};

}  // namespace misalign::solver
