// Extremes of a path whose samples are solved: where a diagonal first turns back, and the least
// rate of change, by solving states between the samples. From sample to sample cubics, and how far
// off they were over the last two, say whether anything may happen between them; only then it is
// looked for.
#pragma once

#include "solver/judging/between_solver.hpp"
#include "solver/records/history.hpp"

namespace misalign::solver {

class SolvedExtremes {
 public:
  /// Both must outlive this object; the solver may be shared.
  SolvedExtremes(const Mechanism& mechanism, BetweenSolver& solver);
  ~SolvedExtremes();
  SolvedExtremes(SolvedExtremes&&);

  /// A new path, of this sheet.
  void begin(const SheetGeometry<double>& geometry);
  /// The same sheet's next sample, which the judge has seen.
  void see(const SheetGeometry<double>& geometry, const Station& station, const PathPoint& point,
           const Judge& judge);
  /// But for bumps.
  const PathExtremes& extremes() const { return extremes_; }

 private:
  // A diagonal goes on before it and back at `high_rad`.
  struct Turn {
    int diagonal, direction;
    double near_rad, high_rad, high_slope;
  };

  void look_from_flat(const SolvedPlace& here, const Judge& judge);
  void go(const SolvedPlace& from, const SolvedPlace& to, double off, int halvings,
          const Judge& judge);
  bool is_clear(const SolvedPlace& from, const SolvedPlace& to, double off,
                const Judge& judge) const;
  void solve_turns(const SolvedPlace& from, const SolvedPlace& to, const Judge& judge);
  double turn_between(const SolvedPlace& from, const SolvedPlace& to, const Turn& turn);
  void take_slopes(const PathPoint& point, const Judge& judge);
  bool may_turn() const { return !extremes_.reverses_deg; }

  const Mechanism& mechanism_;
  BetweenSolver& solver_;
  const SheetGeometry<double>* geometry_ = nullptr;  // while a sample is looked at
  PathExtremes extremes_;
  bool counts_ = false;  // for the least slope, on the way to this sample
  double before_last_rad_ = 0, last_rad_ = 0;
  PathPoint before_last_, last_;  // of the samples; flat first
};

}  // namespace misalign::solver
