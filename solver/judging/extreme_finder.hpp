// Finds extremes of the diagonals' rates of change on a path that is a function: the least rate,
// and sign changes. A parabola between two samples shows whether there may be one; only then the
// function is searched.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "solver/continuation/path_function.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// Extremes of the diagonals' rates of change in their directions, over the path.
struct PathExtremes {
  /// Least rate from kInactiveFrom_deg to D, panel widths per radian; infinite if D lies below.
  double least_slope = std::numeric_limits<double>::infinity();
  /// Beginning of the first bump before D, which no sample shows; if bumps are faults, of the bump
  /// that is the fault.
  std::optional<double> bump_deg;
  int bump_where = -1;  ///< its diagonal
  /// Pilot angle of the first reversal up to the last sample followed.
  std::optional<double> reverses_deg;

  /// Removes the bump, which would have ended D.
  void drop_bump() {
    bump_deg.reset();
    bump_where = -1;
  }
};

/// The first reversal of a diagonal.
struct Reversal {
  int diagonal = -1;     ///< -1: none
  double x = 0;          ///< the function's variable there
  double pilot_deg = 0;  ///< 0: it reverses at flat
  double curvature =
      0;  ///< second derivative of its length, panel widths per radian of pilot squared
};

/// Solves a function's reversal by secants, after a first step by the function's curvature.
class ReversalSecants {
 public:
  explicit ReversalSecants(const Reversal& start = {}) : reversal_(start) {}
  /// Angle to be solved next, given the slopes at the last; none once the reversal is reached, or
  /// is farther off than the function's error.
  std::optional<double> next_deg(const std::vector<double>& slopes);
  /// The reversal so far, and whether it is certain.
  const Reversal& reversal() const { return reversal_; }
  bool is_sure() const { return is_sure_; }
  /// Slope error at a certain reversal, without that of solved slopes.
  double slope_error() const;

 private:
  Reversal reversal_;
  double step_rad_ = 0, slope_ = 0;  // of the solution before
  bool is_sure_ = false;
};

/// The least rate of change, without that at the last sample.
struct LeastSlope {
  double slope = std::numeric_limits<double>::infinity();  ///< see PathExtremes
  double x = 0, pilot_deg = 0;                             ///< see Reversal
};

/// Pilot angle between these two at which a diagonal with this direction reverses, once.
double goes_back_from_deg(const PathFunction& function, int diagonal, int direction,
                          double from_deg, double to_deg);

class ExtremeFinder {
 public:
  explicit ExtremeFinder(int diagonals);
  ~ExtremeFinder();
  ExtremeFinder(const ExtremeFinder&);

  void begin(const std::vector<double>& flat_lengths);
  /// Takes the next sample or node at point `x` of the newest segment: whether it is in order, its
  /// `estimate`, and `judge` with the directions of diagonals.
  void see(double pilot_deg, bool is_in_order, double x, const PathFunction::Estimate& estimate,
           const Judge& judge, const PathFunction& function);
  /// Takes a sample or node without searching the interval before it.
  void pass(double pilot_deg, const PathFunction::Estimate& estimate);
  /// Sets the bump by which a judge has ended.
  void note_bump(int diagonal, double from_deg);
  /// Sets the solved angle of the first reversal.
  void put_reversal(double pilot_deg) { extremes_.reverses_deg = reversal_.pilot_deg = pilot_deg; }
  /// Restores the least slope, as later samples are not in order.
  void restore(const LeastSlope& least_slope) { least_slope_ = least_slope; }

  /// Lengths at the last sample.
  const std::vector<double>& lengths() const { return last_; }
  /// All extremes but the least slope.
  const PathExtremes& extremes() const { return extremes_; }
  const LeastSlope& least_slope() const { return least_slope_; }
  const Reversal& first_reversal() const { return reversal_; }

 private:
  void note_slope(double slope, double x, double pilot_deg);
  void note_reversal(int diagonal, double x, const PathFunction& function);

  PathExtremes extremes_;
  LeastSlope least_slope_;
  Reversal reversal_;
  double last_deg_ = 0;
  std::vector<double> last_, last_slopes_;
  std::vector<double>
      back_since_deg_;  // per diagonal: beginning of its retreat at the last sample, else 0
};

}  // namespace misalign::solver
