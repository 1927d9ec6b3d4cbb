// Paths to 60 degrees on n x n panels, past all faults: the same sheets by every method.
#pragma once

#include <ctime>

#include "solver/continuation/path_follower.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::bench {

inline constexpr double kEnd_deg = 60;

struct LargeSheets {
  explicit LargeSheets(int panels);

  solver::PerforatedSheet base;
  solver::Mechanism mechanism;
  solver::PathPlan plan;                       ///< samples of 1 degree
  std::vector<solver::FlatVertices> drawn_mm;  ///< interior vertices shifted by 0.4 mm
  std::vector<solver::SheetGeometry<double>> drawn;
};

/// What following some of the sheets took.
struct Followed {
  int paths = 0, to_the_end = 0;
  long iterations = 0;
  double cpu_s = 0;

  double path_ms() const { return 1e3 * cpu_s / paths; }
};

/// Hands out the first so many sheets, and wants all of every path.
class WholePaths {
 public:
  WholePaths(const LargeSheets& sheets, int paths) : sheets_(sheets), paths_(paths) {}

  bool next(solver::PathStart& start, int);
  bool see(const solver::Station&, int) { return true; }
  solver::ObserverResult see(const solver::PathFunction&, int) {
    return solver::ObserverResult::go_on;
  }
  void ended(const solver::PathResult& path, int);
  const Followed& followed() const { return followed_; }
  void took(double cpu_s) { followed_.cpu_s = cpu_s; }

 private:
  const LargeSheets& sheets_;
  const int paths_;
  Followed followed_;
};

/// Processor time of this process.
double cpu_now_s();

template <class Follower>
Followed follow(Follower& follower, const LargeSheets& sheets, int paths) {
  WholePaths observer(sheets, paths);
  const double begin_s = cpu_now_s();
  follower.run(observer, observer);
  observer.took(cpu_now_s() - begin_s);
  return observer.followed();
}

/// Eight sheets side by side, as functions or in close steps; for machines with AVX-512 only.
Followed follow_nodes_avx512(const LargeSheets& sheets, const solver::Elimination& elimination,
                             int paths);
Followed follow_close_avx512(const LargeSheets& sheets, const solver::Elimination& elimination,
                             int paths);

}  // namespace misalign::bench
