// Judges one folding path by its samples alone: by the paper's criterion, made exact, that every
// diagonal is monotone, or by the filling's energy.
#pragma once

#include <limits>
#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/verdict/criterion.hpp"
#include "solver/verdict/energy_judge.hpp"
#include "solver/verdict/fault.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::solver {

/// A diagonal that varies by less than this up to D drives nothing (8e-7 mm).
inline constexpr double kInactiveBand_widths = 1e-8;
/// Least D for which inactivity is judged: elongations grow like rho^2, and closer to flat every
/// diagonal has hardly moved. slope_min starts at the same angle.
inline constexpr double kInactiveFrom_deg = 5;
/// A fold angle beyond +-180 degrees by more than this means that panels passed through each other.
inline constexpr double kOverFoldBand_deg = 1e-6;
/// |rho| = 180 degrees + that band has cos(rho / 2) = -sin(band / 2), to first order.
inline constexpr double kLeastCosine = -0.5 * kOverFoldBand_deg * kRadPerDeg;

struct Verdict {
  int deploys_from_sample = 0;  ///< D: all samples up to it are in order
  Fault first_fault = Fault::none;
  int where = -1;  ///< crease (over_folded, assignment_flipped) or diagonal (the others)
  PathEnd path_end = PathEnd::end_reached;  ///< the cause, when undecided
  /// If requested: kScoresPerSample times the samples in order, plus the part by which the fault
  /// was missed, unless a diagonal is inactive.
  int score = kNoScore;

  /// The sample that shows the fault; 0 when there is none.
  int fault_sample() const { return first_fault == Fault::none ? 0 : deploys_from_sample + 1; }
};

/// Results of the cubics between the samples, up to D.
struct Between {
  /// Least rate of change of any diagonal in its direction from kInactiveFrom_deg on, panel widths
  /// per radian; infinite if D lies below.
  double least_slope = std::numeric_limits<double>::infinity();
  /// Angle of the first retreat and its diagonal: none (-1) up to D, or on the last degrees before
  /// D a turn that the next sample shows, or a bump.
  double back_deg = 0;
  int back_where = -1;
  /// The first bump: a diagonal goes back and on again between two samples that are both in order;
  /// if bumps are faults, the bump that is the fault.
  double bump_deg = 0;
  int bump_where = -1;
};

/// Follows the samples of one path and keeps the first fault. It owns its memory and is reused for
/// every draw.
class Judge {
 public:
  /// Bumps are judged by its own cubics, or by its owner (BumpRule::exact).
  explicit Judge(const Mechanism& mechanism, const Criterion& criterion = {});

  /// Starts a path whose diagonals have these flat lengths (panel widths). Friction and
  /// plates of the energy criterion need the sheet's geometry.
  void begin(const std::vector<double>& flat_lengths,
             const SheetGeometry<double>* geometry = nullptr);
  /// Judges the next sample; returns false once a fault is known, after which nothing changes.
  /// A null state means that its creases are known to be in order. The diagonals' slopes (panel
  /// widths per radian of pilot) and the pilot's entry of the unit tangent let it judge the
  /// interval before the sample, and the stop, too.
  bool see(const Station& station, const FoldState<double>* state,
           const std::vector<double>& lengths, const std::vector<double>* slopes = nullptr,
           double pilot_rate = 1);
  /// `see` in two steps, for callers that judge between samples themselves: is_in_order() judges
  /// the next sample, take() accepts it.
  /// `errors` bound those of the lengths, for energy().
  bool is_in_order(const FoldState<double>* state, const std::vector<double>& lengths,
                   const std::vector<double>* errors = nullptr);
  void take(const Station& station, const std::vector<double>& lengths);
  /// Ends with a fault before the next sample: a bump, an undecided one, or a soft stop.
  void end(Fault fault, int where, double missed_part = 0) {
    fault_ = fault;
    where_ = where;
    missed_part_ = missed_part;
  }
  /// Ends with the fault of a diagonal that goes back before the next sample, where its rate is
  /// `rate` (in any unit). `from_deg`, the beginning, is for between() and the score.
  void end_between(int where, double rate, double from_deg = 0);
  /// Drops the fault, so that the next sample is judged again with smaller errors.
  void reconsider() { end(Fault::none, -1); }
  /// Part of a sample by which the next sample, which is not in order, missed its fault
  /// (score.hpp). `step_errors` bound the diagonals' last two steps, `crease_error` the creases'
  /// sines and cosines.
  LeastPart missed_part(const FoldState<double>* state, const std::vector<double>& lengths,
                        const std::vector<double>* step_errors = nullptr,
                        double crease_error = 0) const;
  /// Part of a fault at this pilot angle between D and the next sample; 0 if no sample was in
  /// order.
  LeastPart part_at(double pilot_deg, double error_rad = 0) const;
  /// Part of a fold limit before the next sample; 0 if the path ends otherwise.
  LeastPart limit_part(const PathResult& path, double error_rad = 0) const;
  /// The verdict, once the path has ended or `see` has returned false.
  Verdict conclude(const PathResult& path) const;
  const Between& between() const { return between_; }
  /// Replaces the lengths at the last sample by more accurate ones.
  void correct_last(const std::vector<double>& lengths,
                    const std::vector<double>* errors = nullptr) {
    last_ = lengths;
    if (energy_) energy_->correct_last(lengths, errors);
  }
  /// The judge of the filling's energy, under the energy criterion; else null.
  EnergyJudge* energy() { return energy_ ? &*energy_ : nullptr; }
  Fault fault() const { return fault_; }
  /// Returns whether this step is against the diagonal's direction.
  bool goes_back(int diagonal, double step) const { return direction_[diagonal] * step < 0; }
  int direction(int diagonal) const { return direction_[diagonal]; }
  int samples_in_order() const { return samples_in_order_; }
  /// Variation of the least active diagonal; infinite below kInactiveFrom_deg, and under the energy
  /// criterion, by which diagonals need not be active.
  double least_span() const;

 private:
  Fault fault_in(const FoldState<double>* state, const std::vector<double>& lengths,
                 const std::vector<double>* errors, int& where);
  Fault fault_of_creases(const FoldState<double>& state, int& where) const;
  double longest_step_back(const std::vector<double>& lengths, int& where);
  bool drives_enough(const Station& station, const FoldState<double>* state,
                     const std::vector<double>* slopes);
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
  std::vector<double>
      back_since_deg_;  // per diagonal: beginning of its retreat at the last sample, else 0
  std::vector<int> direction_;
  Between between_;
  std::optional<EnergyJudge> energy_;  // under the energy criterion
};

}  // namespace misalign::solver
