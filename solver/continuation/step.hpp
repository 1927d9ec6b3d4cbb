// What every step along a path has in common, whoever chooses its length: the states it is
// extrapolated from, and when the corrector is believed. No mechanism, no vector: the same for a
// single path, for a lane among others and for a homotopy, whatever solves the equations.
#pragma once

#include "solver/linear/newton.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {

/// Of the last nodes (solved states with their tangents) that a state is extrapolated from.
inline constexpr int kStateNodes = 4;
/// Places for them: one more, so that a node can be taken back.
inline constexpr int kStatePlaces = kStateNodes + 1;

/// Of a path's first state, unless that is flat: all corrections together, as a share of the
/// pilot's angle there. What is farther from the base folding may belong to another branch: of
/// 2,400 sheets with sector angles of 20 to 89.5 degrees the nearest such start was 0.73 off.
inline constexpr double kLongestStartShare = 0.5;

/// What is known after a Newton iteration. The tangent is that of the corrected state, of either
/// direction.
struct NewtonReport {
  double open_by;           ///< before the correction: largest closure entry, radians, panel widths
  double correction_rad;    ///< its largest entry
  int orientation;          ///< sign of det [J; t] for the unit tangent as it was computed
  double tangent_pilot;     ///< that tangent's pilot entry
  double tangent_cosine;    ///< with the tangent at the newest node, as it was oriented
  HalfAngle<double> pilot;  ///< of the corrected state
  /// sin(half of the largest turn of a crease) since the newest node, where the steps ask for it.
  double largest_half_sine = 0;

  bool is_finite() const;
  /// Of the Jacobian without the pilot's column.
  int determinant_sign() const { return tangent_pilot < 0 ? -orientation : orientation; }
};

/// What to do with a lane now.
struct PathStep {
  bool keep = false;         ///< the corrected state is the newest node
  bool uncorrected = false;  ///< and its last correction is not taken
  double tangent_sign = 1;   ///< with which its tangent is kept
  bool arrived = false;      ///< at a state to be seen before `proceed`
  bool ended = false;        ///< result() says how
  bool depart = false;       ///< to the state that these weights make of the last nodes, by place
  double of_values[kStatePlaces] = {}, of_rates[kStatePlaces] = {}, of_flat = 0;
  bool hold = false;  ///< put the pilot at `pilot` after departing
  HalfAngle<double> pilot{1, 0};

  /// The polynomial through `count` nodes, `newest` of all counted from 0 on: the newest first, at
  /// `at` with these rates of the variable per unit of arc length; and through flat, at 0.
  void extrapolate(const double* at, const double* rates, int count, int newest, bool from_flat,
                   double x);
  /// From a node along its tangent (Euler).
  void go_along(int node, double length);
};

/// One run of the corrector, from departing until its state closes all loops or is given up.
class Correction {
 public:
  enum class Now { goes_on, closed, given_up };
  struct Options {
    double closure_tolerance;
    int least = 0, most;  ///< corrections
    double longest_rad;   ///< of all of them together
    /// By which each must divide the opening once a solution is found; 0: whatever. Newton's method
    /// squares it there. At a branch point, where solutions are double, it divides it by four, and
    /// a state is known to the root of it only.
    double least_gain = 0;
  };

  void begin() { *this = {}; }
  /// A first one of a path starts from another sheet's state: near flat it closes the loops better
  /// than its error in the joints lets the second, so that one may open them again.
  Now after(const NewtonReport& report, const Options& options, bool is_first);

  /// How far off the prediction was, as the first of them has it.
  double first_rad() const { return first_rad_; }

 private:
  int count_ = 0;
  double corrected_rad_ = 0, first_rad_ = 0, last_open_ = 0;
};

/// Whether a state that closes all loops belongs to the path's own curve, on its way forward: its
/// tangent has turned little since the newest node, and [J; t] keeps the sign of its determinant.
bool is_own_curve(const NewtonReport& report, double tangent_sign, int forward_sign,
                  double least_tangent_cosine);

}  // namespace misalign::solver
