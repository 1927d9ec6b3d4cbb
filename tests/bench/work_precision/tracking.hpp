// The production solver as a method of the study: solver::PathFollower, on one sheet after another
// or on as many as a register has lanes. Every station is a sample.
#pragma once

#include "solver/continuation/path_follower.hpp"
#include "tests/bench/work_precision/problem.hpp"

namespace misalign::bench {

/// Hands out the problem's sheets and records their lengths. Compiled once, for every machine: the
/// files with wider registers instantiate nothing but the path follower.
class ProblemObserver {
 public:
  ProblemObserver(const Problem& problem, const Demand& demand, int lanes);

  const solver::Mechanism& mechanism() const { return problem_.mechanism(); }
  const solver::Elimination& elimination() const { return elimination_; }
  const solver::StepControlOptions& options() const { return options_; }

  /// As many tracks as sheets.
  void begin(std::vector<Track>& tracks);
  bool next(solver::PathStart& start, int lane);
  solver::PathPoint& point() { return point_; }
  bool wants_slopes() const { return false; }
  bool see(const solver::Station&, int lane);
  void ended(const solver::PathResult& path, int lane);

 private:
  const Problem& problem_;
  const solver::Elimination elimination_;
  const solver::PathPlan plan_;
  solver::StepControlOptions options_;
  solver::PathPoint point_;
  std::vector<std::size_t> sheet_of_lane_;
  std::size_t next_ = 0;
  std::vector<Track>* tracks_ = nullptr;
};

template <class T>
class Tracking {
 public:
  Tracking(const Problem& problem, const Demand& demand)
      : observer_(problem, demand, solver::kLanes<T>),
        follower_(observer_.mechanism(), observer_.elimination(), observer_.options()) {}

  void follow(std::vector<Track>& tracks) {
    observer_.begin(tracks);
    follower_.run(observer_);
  }

 private:
  ProblemObserver observer_;
  solver::PathFollower<T> follower_;
};

Run track_one_by_one(const Problem& problem, const Demand& demand);
#ifdef MISALIGN_X86
/// For machines with AVX-512 only: eight sheets side by side.
Run track_in_lanes(const Problem& problem, const Demand& demand);
#endif

}  // namespace misalign::bench
