// The diagonals' rates of change all over a path that is a function: the least of them, and where
// one of them changes its sign. From sample to sample a parabola says whether anything may happen
// between them; only then the function is searched.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "solver/continuation/path_function.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// Of the diagonals' rates of change in their directions, all over the path.
struct PathExtremes {
  /// The least from kInactiveFrom_deg to D, panel widths per radian; infinite if D lies below.
  double least_slope = std::numeric_limits<double>::infinity();
  /// Where a diagonal first goes back, and on again before D without a sample having shown it; or
  /// where bumps are asked for, the one that is the fault.
  std::optional<double> bump_deg;
  int bump_where = -1;  ///< which one
  /// Where a diagonal first turns back, up to the last sample that was followed.
  std::optional<double> reverses_deg;

  /// There is none: it would have ended D.
  void drop_bump() {
    bump_deg.reset();
    bump_where = -1;
  }
};

/// Where a diagonal turns back for the first time.
struct Reversal {
  int diagonal = -1;     ///< -1: none does
  double x = 0;          ///< the variable of the function that showed it
  double pilot_deg = 0;  ///< 0: it sets out the other way
  double curvature = 0;  ///< of its length, panel widths per radian of pilot squared
};

/// Solves a reversal that a function has: by secants, after the first step by the function's
/// curvature.
class ReversalSecants {
 public:
  explicit ReversalSecants(const Reversal& found = {}) : reversal_(found) {}
  /// Where it is to be solved next, with these slopes where it was last; nothing once it is there,
  /// or farther off than the function may be.
  std::optional<double> next_deg(const std::vector<double>& slopes);
  /// Where it is by now, and whether that is sure.
  const Reversal& reversal() const { return reversal_; }
  bool is_sure() const { return is_sure_; }
  /// How far off its slope may be where it is sure, but for what solved slopes are worth.
  double slope_error() const;

 private:
  Reversal reversal_;
  double step_rad_ = 0, slope_ = 0;  // of the solution before
  bool is_sure_ = false;
};

/// Where a rate of change is the least, but for the last sample that was seen.
struct LeastSlope {
  double slope = std::numeric_limits<double>::infinity();  ///< as in PathExtremes
  double x = 0, pilot_deg = 0;                             ///< as in Reversal
};

/// Where a diagonal that goes in this direction turns back between these pilot angles, once.
double goes_back_from_deg(const PathFunction& function, int diagonal, int direction,
                          double from_deg, double to_deg);

class ExtremeFinder {
 public:
  explicit ExtremeFinder(int diagonals);
  ~ExtremeFinder();
  ExtremeFinder(const ExtremeFinder&);

  void begin(const std::vector<double>& flat_lengths);
  /// The next sample, or another node, at this point of the newest segment; whether it is in
  /// order, `here` is what is known of it, and `judge` which way diagonals go.
  void see(double pilot_deg, bool is_in_order, double x, const PathFunction::Estimate& here,
           const Judge& judge, const PathFunction& function);
  /// The same, but that nothing is known of what lies between it and the sample before.
  void pass(double pilot_deg, const PathFunction::Estimate& here);
  /// The bump by which a judge has ended.
  void note_bump(int diagonal, double from_deg);
  /// The first reversal, solved.
  void put_reversal(double pilot_deg) { extremes_.reverses_deg = reversal_.pilot_deg = pilot_deg; }
  /// What was seen since is not in order.
  void restore(const LeastSlope& least_slope) { least_slope_ = least_slope; }

  /// At the last sample that was seen.
  const std::vector<double>& lengths() const { return last_; }
  /// All but the least slope.
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
  std::vector<double> back_since_deg_;  // of diagonals that go back at the last sample; else 0
};

}  // namespace misalign::solver
