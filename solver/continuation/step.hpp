// Defines a step along a path, whatever chooses its length: the states from which it is
// extrapolated, and the conditions for accepting a correction. Without mechanism or vector it
// serves a single path, a lane and a homotopy alike.
#pragma once

#include "solver/linear/newton.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {

/// Number of last nodes (solved states with their tangents) from which a state is extrapolated.
inline constexpr int kStateNodes = 4;
/// Places for them: one more, so that a node can be taken back.
inline constexpr int kStatePlaces = kStateNodes + 1;

/// Largest sum of corrections of a path's first state, unless that is flat, as a share of the
/// pilot's angle. A state farther from the base folding may belong to another branch: of 2,400
/// sheets with sector angles of 20 to 89.5 degrees the nearest such start was 0.73 off.
inline constexpr double kLongestStartShare = 0.5;

/// Results of a Newton iteration. The tangent is that of the corrected state, of either direction.
struct NewtonReport {
  double open_by;           ///< largest closure entry before the correction, radians, panel widths
  double correction_rad;    ///< largest entry of the correction
  int orientation;          ///< sign of det [J; t] for the computed unit tangent
  double tangent_pilot;     ///< the tangent's pilot entry
  double tangent_cosine;    ///< cosine with the oriented tangent at the newest node
  HalfAngle<double> pilot;  ///< pilot of the corrected state
  /// sin(half of the largest turn of a crease) since the newest node, if requested.
  double largest_half_sine = 0;

  bool is_finite() const;
  /// Sign of the determinant of the Jacobian without the pilot's column.
  int determinant_sign() const { return tangent_pilot < 0 ? -orientation : orientation; }
};

/// Instructions for a lane.
struct PathStep {
  bool keep = false;         ///< the corrected state is the newest node
  bool uncorrected = false;  ///< the last correction is not taken
  double tangent_sign = 1;   ///< sign with which its tangent is kept
  bool arrived = false;      ///< the observer sees this state before `proceed`
  bool ended = false;        ///< result() says how
  bool depart = false;       ///< go to the state with these weights of the last nodes, by place
  double of_values[kStatePlaces] = {}, of_rates[kStatePlaces] = {}, of_flat = 0;
  bool hold = false;  ///< put the pilot at `pilot` after departing
  HalfAngle<double> pilot{1, 0};

  /// Extrapolates to x by the polynomial through the last `count` nodes, the newest first (number
  /// `newest`, counted from 0), at `at` with the variable's `rates` per unit of arc length, and
  /// with `from_flat` through flat at 0.
  void extrapolate(const double* at, const double* rates, int count, int newest, bool from_flat,
                   double x);
  /// Predicts along a node's tangent (Euler).
  void go_along(int node, double length);
};

/// One run of the corrector, from departing until its state closes all loops or is given up.
class Correction {
 public:
  enum class Now { goes_on, closed, given_up };
  struct Options {
    double closure_tolerance;
    int least = 0, most;  ///< corrections
    double longest_rad;   ///< all corrections together
    /// Least factor by which a correction must reduce the opening next to a solution; 0: any.
    /// Newton's method squares the opening there. At a branch point solutions are double: it
    /// divides the opening by four, and the state's error is the opening's root.
    double least_gain = 0;
  };

  void begin() { *this = {}; }
  /// A path's first state starts from another sheet's. Near flat that closes the loops better than
  /// its error in the joints lets the second iterate, which may open them again.
  Now after(const NewtonReport& report, const Options& options, bool is_first);

  /// The first correction: the error of the prediction.
  double first_rad() const { return first_rad_; }

 private:
  int count_ = 0;
  double corrected_rad_ = 0, first_rad_ = 0, last_open_ = 0;
};

/// Returns whether a state that closes all loops lies ahead on the path's own curve: its tangent
/// has turned little since the newest node, and [J; t] keeps the sign of its determinant.
bool is_own_curve(const NewtonReport& report, double tangent_sign, int forward_sign,
                  double least_tangent_cosine);

}  // namespace misalign::solver
