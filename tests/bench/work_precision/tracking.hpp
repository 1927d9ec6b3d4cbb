// The production solvers as methods of the study, on one sheet after another or on as many as a
// register has lanes: solver::PathFollower in close steps, whose every station is a sample, and in
// long ones, of whose polynomials samples are asked.
#pragma once

#include "solver/continuation/path_follower.hpp"
#include "tests/bench/work_precision/problem.hpp"

namespace misalign::bench {

/// Hands out the problem's sheets and records their lengths. Compiled once, for every machine: the
/// files with wider registers instantiate nothing but the followers.
class ProblemObserver {
 public:
  ProblemObserver(const Problem& problem, const Demand& demand, int lanes);

  const solver::Mechanism& mechanism() const { return problem_.mechanism(); }
  const solver::Elimination& elimination() const { return elimination_; }

  /// As many tracks as sheets.
  void begin(std::vector<Track>& tracks);
  bool next(solver::PathStart& start, int lane);
  void ended(const solver::PathResult& path, int lane);

 protected:
  Track& track(int lane) { return (*tracks_)[sheet_of_lane_[lane]]; }

  const Problem& problem_;
  const solver::Elimination elimination_;
  const solver::PathPlan plan_;

 private:
  std::vector<std::size_t> sheet_of_lane_;
  std::size_t next_ = 0;
  std::vector<Track>* tracks_ = nullptr;
};

/// The tolerance is that of every station's closure.
class StationObserver : public ProblemObserver {
 public:
  StationObserver(const Problem& problem, const Demand& demand, int lanes);

  const solver::CloseSteps::Options& options() const { return options_; }
  solver::PathPoint& point() { return point_; }
  bool wants_slopes() const { return false; }
  bool see(const solver::Station&, int lane);

 private:
  solver::CloseSteps::Options options_;
  solver::PathPoint point_;
};

/// The tolerance is what a segment's polynomials may change by at its middle without their last
/// node.
class FunctionObserver : public ProblemObserver {
 public:
  FunctionObserver(const Problem& problem, const Demand& demand, int lanes);

  const solver::LongSteps::Options& options() const { return options_; }
  solver::ObserverResult see(const solver::PathFunction& function, int lane);

 private:
  const std::size_t diagonals_;
  solver::LongSteps::Options options_;
  solver::PathFunction::Estimate estimate_;
};

template <class Follower, class Observer>
class Tracking {
 public:
  Tracking(const Problem& problem, const Demand& demand)
      : observer_(problem, demand, Follower::kWidth),
        follower_(observer_.mechanism(), observer_.elimination(), observer_.options()) {}

  void follow(std::vector<Track>& tracks) {
    observer_.begin(tracks);
    follower_.run(observer_, observer_);
  }

 private:
  Observer observer_;
  Follower follower_;
};

template <class T>
using StationTracking = Tracking<solver::PathFollower<T>, StationObserver>;
template <class T>
using FunctionTracking = Tracking<solver::PathFollower<T, solver::LongSteps>, FunctionObserver>;

Run track_one_by_one(const Problem& problem, const Demand& demand);
Run functions_one_by_one(const Problem& problem, const Demand& demand);
#ifdef MISALIGN_X86
/// For machines with AVX-512 only: eight sheets side by side.
Run track_in_lanes(const Problem& problem, const Demand& demand);
Run functions_in_lanes(const Problem& problem, const Demand& demand);
#endif

}  // namespace misalign::bench
