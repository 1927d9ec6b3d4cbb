// The verdict on one folding path, from its samples alone (the paper's criterion, made exact).
#pragma once

#include <limits>
#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/verdict/criterion.hpp"
#include "solver/verdict/fault.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::solver {

/// A step shorter than this neither sets nor breaks a diagonal's direction (8e-11 mm on 80 mm
/// panels): converged lengths differ by less, and without a band patterns with few shifts would be
/// decided by rounding.
inline constexpr double kStepBand_widths = 1e-12;
/// A diagonal that varies by less than this up to D drives nothing (8e-7 mm).
inline constexpr double kInactiveBand_widths = 1e-8;
/// Inactivity is judged for D from here on: elongations grow like rho^2, and closer to flat every
/// diagonal has hardly moved. The same angle from which slope_min is taken.
inline constexpr double kInactiveFrom_deg = 5;
/// A fold angle beyond +-180 degrees by more than this means that panels passed through each other.
inline constexpr double kOverFoldBand_deg = 1e-6;
/// |rho| = 180 degrees + that band has cos(rho / 2) = -sin(band / 2), to first order.
inline constexpr double kLeastCosine = -0.5 * kOverFoldBand_deg * kRadPerDeg;

struct Verdict {
  int deploys_from_sample = 0;  ///< D: every sample up to it is in order
  Fault first_fault = Fault::none;
  int where = -1;  ///< crease (over_folded, assignment_flipped) or diagonal (the others)
  PathEnd path_end = PathEnd::end_reached;  ///< the cause, when undecided
  /// Where scores are asked for: kScoresPerSample times the samples in order, unless a
  /// diagonal is inactive, and the part by which the fault was missed.
  int score = kNoScore;

  /// The sample that shows the fault; 0 when there is none.
  int fault_sample() const { return first_fault == Fault::none ? 0 : deploys_from_sample + 1; }
};

/// What the cubics between the samples showed, up to D.
struct Between {
  /// Least rate of change of any diagonal in its direction from kInactiveFrom_deg on, panel widths
  /// per radian; infinite if D lies below.
  double least_slope = std::numeric_limits<double>::infinity();
  /// Where a diagonal goes back for the first time, and which: nothing (-1) up to D, or on the last
  /// degrees before D a turn that the next sample shows, or a bump.
  double back_deg = 0;
  int back_where = -1;
  /// The first bump: a diagonal goes back and on again between two samples, which both are in
  /// order; where bumps are asked for, the one that is the fault.
  double bump_deg = 0;
  int bump_where = -1;
};

/// Follows the samples of one path and keeps the first fault. Owns its memory; reused from draw to
/// draw.
class Judge {
 public:
  /// Bumps count by the cubics that it sees, or as its owner says (BumpRule::exact).
  explicit Judge(const Mechanism& mechanism, const Criterion& criterion = {});

  /// Starts a path whose diagonals have these flat lengths (panel widths).
  void begin(const std::vector<double>& flat_lengths);
  /// The next sample in order; false once a fault is known. Nothing changes after that. Without a
  /// state its creases are known to be in order. With the diagonals' slopes (panel widths per
  /// radian of pilot), and the pilot's entry of the unit tangent, it looks between the samples as
  /// well, and at the stop that is asked for.
  bool see(const Station& station, const FoldState<double>* state,
           const std::vector<double>& lengths, const std::vector<double>* slopes = nullptr,
           double pilot_rate = 1);
  /// The same in two steps, for who looks between the samples first: whether the next sample itself
  /// is in order, and that it counts.
  bool is_in_order(const FoldState<double>* state, const std::vector<double>& lengths);
  void take(const Station& station, const std::vector<double>& lengths);
  /// What was seen before the next sample: a bump, or that it cannot be known; or a soft stop.
  void end(Fault fault, int where, double missed_part = 0) {
    fault_ = fault;
    where_ = where;
    missed_part_ = missed_part;
  }
  /// A diagonal goes back before the next sample, at which it changes by `rate` (of any unit): ends
  /// with the fault that this is. `from_deg`, where it begins, is for between() and the score.
  void end_between(int where, double rate, double from_deg = 0);
  /// The next sample is to be looked at again, better known.
  void reconsider() { end(Fault::none, -1); }
  /// The part of a sample by which the next one, which is not in order, missed it (see score.hpp),
  /// where each diagonal's steps to it and before it, and the creases' sines and cosines are known
  /// to within these errors.
  LeastPart missed_part(const FoldState<double>* state, const std::vector<double>& lengths,
                        const std::vector<double>* step_errors = nullptr,
                        double crease_error = 0) const;
  /// The same of a fault at this pilot angle between D and the next sample; 0 where no sample was
  /// in order.
  LeastPart part_at(double pilot_deg, double error_rad = 0) const;
  /// The same where the path ends in a fold limit before the next sample; 0 where it does not.
  LeastPart limit_part(const PathResult& path, double error_rad = 0) const;
  /// The verdict, once the path has ended or `see` has said false.
  Verdict conclude(const PathResult& path) const;
  const Between& between() const { return between_; }
  /// The lengths at the last sample, better known.
  void correct_last(const std::vector<double>& lengths) { last_ = lengths; }
  Fault fault() const { return fault_; }
  /// Whether this step is against the direction that the diagonal has set.
  bool goes_back(int diagonal, double step) const { return direction_[diagonal] * step < 0; }
  int direction(int diagonal) const { return direction_[diagonal]; }
  int samples_in_order() const { return samples_in_order_; }
  /// By how much the least active diagonal has varied; what is judged near flat counts as much.
  double least_span() const;

 private:
  Fault fault_in(const FoldState<double>* state, const std::vector<double>& lengths, int& where);
  int score(const PathResult& path) const;
  double sample_rad() const;
  Between seen_between(const Station& station, const std::vector<double>& lengths,
                       const std::vector<double>& slopes, double pilot_rate);

  const Mechanism& mechanism_;
  const Criterion criterion_;
  int samples_in_order_ = 0;
  double last_pilot_deg_ = 0, last_pilot_rate_ = 0;
  Fault fault_ = Fault::none;
  int where_ = -1;
  double missed_part_ = 0;
  std::vector<double> last_, before_last_, last_slopes_, least_, most_;
  std::vector<double> back_since_deg_;  // of diagonals that go back at the last sample; else 0
  std::vector<int> direction_;
  Between between_;
};

}  // namespace misalign::solver
