// Judges one path in close steps by a Judge of its solved samples, and between samples by the path
// as a function through them.
#pragma once

#include <vector>

#include "solver/judging/extreme_finder.hpp"
#include "solver/judging/function_bumps.hpp"
#include "solver/judging/solved_function.hpp"
#include "solver/model/model.hpp"

namespace misalign::solver {

class CloseJudge {
 public:
  /// Both must outlive this object; judges may share the solver.
  CloseJudge(const Model& model, BetweenSolver& solver);
  ~CloseJudge();
  CloseJudge(CloseJudge&&);

  /// Begins a path; `finds_extremes` requests its extremes, also beyond faults.
  /// `geometry` as for Judge::begin.
  void begin(const std::vector<double>& flat_lengths, const SheetGeometry<double>& geometry,
             bool finds_extremes = false);
  /// Takes the samples before the next one as known, after `begin`: `lengths` has a row for each.
  /// The path between samples is known to be in order up to the sample `known`.
  void go_on(const PathPlan& plan, const std::vector<double>& lengths, int known);
  /// Judges the next sample, with its slopes if they are needed; returns false once a fault is
  /// known. `geometry` is the sheet's, needed if looks_between().
  bool see(const Station& station, const PathPoint& point, bool with_slopes,
           const SheetGeometry<double>* geometry);
  /// Returns whether it judges between samples: this needs slopes and rates, and may solve states
  /// there.
  bool looks_between() const { return looks_for_bumps_ || finds_extremes_; }
  Verdict conclude(const PathResult& path) const { return judge_.conclude(path); }
  const Between& between() const { return judge_.between(); }
  PathExtremes extremes() const;

 private:
  void look_between(const Station& station, const PathPoint& point,
                    const SheetGeometry<double>& geometry);
  bool is_short_enough();
  void find_extremes();
  void solve_reversal();

  const Mechanism& mechanism_;
  const bool looks_for_bumps_;
  bool finds_extremes_ = false;
  Judge judge_;
  SolvedFunction path_;
  FunctionBumps bumps_;
  FunctionBumps::Heading heading_ = FunctionBumps::Heading::forward;
  int known_ = 0;  // samples up to which the path between them is known
  bool is_over_ = false;
  bool is_believed_ = true;  // true if the newest segment's polynomials have converged
  double last_deg_ = 0;      // pilot angle of the last sample
  ExtremeFinder finder_;
  double least_slope_at_last_ = 0;
  PathFunction::Estimate estimate_;
};

}  // namespace misalign::solver
