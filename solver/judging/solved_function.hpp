// A path in close steps as a function: a node at every sample, and more of them between two
// samples where that is asked for.
#pragma once

#include <array>

#include "solver/continuation/path_function.hpp"
#include "solver/judging/between_solver.hpp"

namespace misalign::solver {

class SolvedFunction {
 public:
  /// Both must outlive this object; the solver may be shared.
  SolvedFunction(const Mechanism& mechanism, BetweenSolver& solver);
  ~SolvedFunction();
  SolvedFunction(SolvedFunction&&);

  void begin(const std::vector<double>& flat_lengths);
  /// A segment to the next sample, with its slopes and rates; both must last until it is reached.
  /// From flat it goes halfway: one node alone makes no function. False: no state was found there.
  bool aim_at(const SheetGeometry<double>& geometry, const Station& sample, const PathPoint& point);
  /// Half that segment instead, or less of it. False: no state was found there, and it stays as it
  /// is.
  bool halve();
  bool can_halve() const { return solves_ < kMostSolves; }
  /// The segment is short enough: the next one begins at its end.
  void keep();
  /// From there a segment twice as long, at most to the sample. False: that is reached.
  bool go_on();

  /// A state of the newest segment, until another one is solved; null: none is found there.
  const PathPoint* state_at(double pilot_rad);

  /// Up to the end of the newest segment.
  const PathFunction& function() const { return function_; }
  bool is_at_sample() const { return end_rad_ == sample_rad_; }
  double end_rad() const { return end_rad_; }
  const PathPoint& end() const { return is_at_sample() ? *sample_ : rooms_[middle_]; }

 private:
  // Between two samples. Next to a sharp fold limit some twenty were needed.
  static constexpr int kMostSolves = 64;

  bool solve(double pilot_rad);
  void add();

  const Mechanism& mechanism_;
  BetweenSolver& solver_;
  PathFunction function_;
  PathPoint last_;                  // where the segment begins
  std::array<PathPoint, 2> rooms_;  // where it ends if not at the sample, and what is solved next
  std::size_t middle_ = 0;
  double last_rad_ = 0, end_rad_ = 0, sample_rad_ = 0, length_rad_ = 0;
  const SheetGeometry<double>* geometry_ = nullptr;
  const PathPoint* sample_ = nullptr;
  int solves_ = 0;
};

}  // namespace misalign::solver
