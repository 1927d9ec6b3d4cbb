// Represents a path in close steps as a function: with a node at every sample, and on request more
// between two samples.
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
  /// Passes a sample, at which a node is made, and judges nothing before it.
  void pass(const Station& sample, const PathPoint& point);
  /// Begins a segment to the next sample, with its slopes and rates; both must last until it is
  /// reached. From flat the segment ends halfway, since one node is no function. Returns false if
  /// no state is found there.
  bool aim_at(const SheetGeometry<double>& geometry, const Station& sample, const PathPoint& point);
  /// Replaces the segment by its first half, or less. Returns false if no state is found there; the
  /// segment then stays.
  bool halve();
  bool can_halve() const { return solves_ < kMostSolves; }
  /// Keeps the segment: the next one begins at its end.
  void keep();
  /// Begins a segment twice as long, at most up to the sample. Returns false if that is reached.
  bool go_on();

  /// A state of the newest segment, valid until the next is solved; null if none is found.
  const PathPoint* state_at(double pilot_rad);

  /// The function up to the end of the newest segment.
  const PathFunction& function() const { return function_; }
  bool is_at_sample() const { return end_rad_ == sample_rad_; }
  double end_rad() const { return end_rad_; }
  const PathPoint& end() const { return is_at_sample() ? *sample_ : rooms_[middle_]; }

 private:
  // Largest number of solves between two samples. Some twenty were needed next to a sharp fold
  // limit.
  static constexpr int kMostSolves = 64;

  void begin_segment(const Station& sample, const PathPoint& point);
  bool solve(double pilot_rad);
  void add();

  const Mechanism& mechanism_;
  BetweenSolver& solver_;
  PathFunction function_;
  PathPoint last_;                  // the segment's beginning
  std::array<PathPoint, 2> rooms_;  // its end if not at the sample, and the next state
  std::size_t middle_ = 0;
  double last_rad_ = 0, end_rad_ = 0, sample_rad_ = 0, length_rad_ = 0;
  const SheetGeometry<double>* geometry_ = nullptr;
  const PathPoint* sample_ = nullptr;
  int solves_ = 0;
};

}  // namespace misalign::solver
