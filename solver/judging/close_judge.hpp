// The verdict on one path in close steps, whose samples are solved: a Judge. What lies between the
// samples is asked of the path as a function through them.
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

  /// The extremes of the path, past faults too, where they are wanted.
  void begin(const std::vector<double>& flat_lengths, bool finds_extremes = false);
  /// The next sample, with its slopes if those are to be looked at; false once a fault is known.
  /// `geometry`: of the sheet, if looks_between().
  bool see(const Station& station, const PathPoint& point, bool with_slopes,
           const SheetGeometry<double>* geometry);
  /// Whether it looks between the samples: needs slopes and rates, and may solve states there.
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
  bool is_over_ = false;
  bool is_believed_ = true;  // the newest segment, as a function
  double last_deg_ = 0;      // the last sample
  ExtremeFinder finder_;
  double least_slope_at_last_ = 0;
  PathFunction::Estimate here_;
};

}  // namespace misalign::solver
