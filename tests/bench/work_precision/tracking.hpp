// The production solver as a method of the study: solver::Tracker, on one sheet after another or on
// as many as a register has lanes. Every stop is a sample.
#pragma once

#include "solver/continuation/path_follower.hpp"
#include "tests/bench/work_precision/problem.hpp"

namespace misalign::bench {

/// Hands out the problem's sheets and records their lengths. Compiled once, for every machine: the
/// files with wider registers instantiate nothing but the tracker.
class PathDesk {
 public:
  PathDesk(const Problem& problem, const Demand& demand, int lanes);

  const solver::Mechanism& mechanism() const { return problem_.mechanism(); }
  const solver::Elimination& elimination() const { return elimination_; }
  const solver::CourseOptions& options() const { return options_; }

  /// As many tracks as sheets.
  void begin(std::vector<Track>& tracks);
  bool next(solver::Departure& departure, int lane);
  /// What the lane's lengths are written to before `visit`.
  double* lengths() { return lengths_.data(); }
  bool visit(int lane);
  void ended(const solver::PathResult& path, int lane);

 private:
  const Problem& problem_;
  const solver::Elimination elimination_;
  const solver::PathPlan plan_;
  solver::CourseOptions options_;
  std::vector<double> lengths_;
  std::vector<std::size_t> sheet_of_lane_;
  std::size_t next_ = 0;
  std::vector<Track>* tracks_ = nullptr;
};

template <class T>
class Tracking {
 public:
  Tracking(const Problem& problem, const Demand& demand)
      : desk_(problem, demand, solver::kLanes<T>),
        tracker_(desk_.mechanism(), desk_.elimination(), desk_.options()) {}

  void follow(std::vector<Track>& tracks) {
    desk_.begin(tracks);
    Client client{desk_, tracker_};
    tracker_.run(client);
  }

 private:
  struct Client {
    PathDesk& desk;
    solver::Tracker<T>& tracker;
    bool next(solver::Departure& departure, int lane) { return desk.next(departure, lane); }
    bool visit(const solver::Stop&, int lane) {
      tracker.copy_lengths(lane, desk.lengths());
      return desk.visit(lane);
    }
    void ended(const solver::PathResult& path, int lane) { desk.ended(path, lane); }
  };

  PathDesk desk_;
  solver::Tracker<T> tracker_;
};

Run track_one_by_one(const Problem& problem, const Demand& demand);
#ifdef MISALIGN_X86
/// For machines with AVX-512 only: eight sheets side by side.
Run track_in_lanes(const Problem& problem, const Demand& demand);
#endif

}  // namespace misalign::bench
