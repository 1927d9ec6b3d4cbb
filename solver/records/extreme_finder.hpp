// The diagonals' rates of change all over a path that is a function: the least of them, and where
// one of them changes its sign. From sample to sample a parabola says whether anything may happen
// between them; only then the function is searched.
#pragma once

#include <vector>

#include "solver/judging/function_judge.hpp"
#include "solver/records/path_record.hpp"

namespace misalign::solver {

/// Where a diagonal turns back for the first time.
struct Reversal {
  int diagonal = -1;     ///< -1: none does
  double x = 0;          ///< the variable of the function that showed it
  double pilot_deg = 0;  ///< 0: it sets out the other way
  double curvature = 0;  ///< of its length, panel widths per radian of pilot squared
};

/// Where a rate of change is the least, but for the last sample that was seen.
struct LeastSlope {
  double slope = std::numeric_limits<double>::infinity();  ///< as in PathExtremes
  double x = 0, pilot_deg = 0;                             ///< as in Reversal
};

class ExtremeFinder {
 public:
  explicit ExtremeFinder(int diagonals);
  ~ExtremeFinder();
  ExtremeFinder(const ExtremeFinder&);

  void begin(const std::vector<double>& flat_lengths);
  /// The next sample, at this point of the newest segment; `here` is what is known of it, and
  /// `judge` which samples are in order, and which way diagonals go.
  void see(const Station& station, double x, const PathEstimate& here, const FunctionJudge& judge,
           const PathFunction& function);

  /// The bump between these stations by which the judge has ended.
  void note_bump(const Station& from, const Station& to, const FunctionJudge& judge,
                 const PathFunction& function);

  /// At the last sample that was seen.
  const std::vector<double>& lengths() const { return last_; }
  /// All but the least slope.
  const PathExtremes& extremes() const { return extremes_; }
  const LeastSlope& least_slope() const { return least_slope_; }
  const Reversal& first_reversal() const { return reversal_; }

 private:
  struct Subsegment {
    const PathFunction& function;
    int diagonal, direction;
    double from, to;  // of the function's variable

    double slope(double x) const { return direction * function.slope(diagonal, x); }
    double root_of_slope(double high) const;
    double least_slope_at() const;
  };
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
