// Full paths of sheets that somebody looks at, for a tracker of any width: hands each stop, with
// its diagonals and its smallest singular value, to the recording of its lane.
#pragma once

#include "solver/history.hpp"
#include "solver/singular_value.hpp"
#include "solver/stop_copy.hpp"
#include "solver/tracker.hpp"

namespace misalign::solver {

/// `Desk` says which sheet is next (`next`), whose recording a lane writes (`of_lane`), and takes
/// the end of each path (`ended`).
template <class T, class Desk>
class RecordingClient {
 public:
  RecordingClient(const Mechanism& mechanism, Tracker<T>& tracker, Desk& desk)
      : tracker_(tracker),
        desk_(desk),
        factors_(tracker.factors()),
        smallest_(mechanism.equations),
        stop_(mechanism) {}

  bool next(Departure& departure, int lane) {
    smallest_.restart(lane);
    return desk_.next(departure, lane);
  }

  /// Singular values of all lanes that have arrived, before their visits.
  void arrivals(const T& arrived) { singular_value_ = smallest_.of(factors_, arrived); }

  bool visit(const Stop& stop, int i) {
    tracker_.copy_state(i, stop_.state);
    tracker_.copy_lengths(i, stop_.lengths.data());
    desk_.of_lane(i).see(stop, stop_.state, stop_.lengths, lane(singular_value_, i));
    return true;
  }

  void ended(const PathResult& path, int lane) { desk_.ended(path, lane); }

 private:
  Tracker<T>& tracker_;
  Desk& desk_;
  SquareFactors<T> factors_;
  SmallestSingularValue<T> smallest_;
  T singular_value_;
  StopCopy stop_;
};

}  // namespace misalign::solver
