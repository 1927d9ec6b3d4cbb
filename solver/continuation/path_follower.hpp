// The folding paths of many sheets of one topology side by side, one in each lane, each at its own
// angle; a lane takes the next sheet as soon as its own path has ended. With T = double it follows
// one path, and that is the definition: a lane has its bits, whatever its neighbours do.
//
// Stops are reached by extrapolation and Newton's method with the pilot held. Where that fails or
// leaves this half of the curve, the lane walks along the curve itself: Euler predictor,
// Moore-Penrose corrector (Allgower & Georg, Introduction to Numerical Continuation Methods, ch. 3
// and 6). Course decides which.
#pragma once

#include <array>
#include <vector>

#include "solver/continuation/step_control.hpp"
#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/lane_state.hpp"
#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {

/// One path to follow: the sheet, and a state near the plan's stop number `first_stop`.
struct Departure {
  const SheetGeometry<double>* geometry;
  const FoldState<double>* start;
  const PathPlan* plan;
  std::size_t first_stop = 0;
  int forward_sign = 0;  ///< of the determinant on this half of the curve; 0: not known
};

template <class T>
class Tracker {
 public:
  static constexpr int kWidth = kLanes<T>;

  /// Both must outlive this object, which owns its memory from the start.
  Tracker(const Mechanism& mechanism, const Elimination& elimination,
          const CourseOptions& options = {});

  /// Follows paths until `client` has no more of them. It has
  ///   bool next(Departure&, int lane)    the next path, for this lane; false: none is left
  ///   bool visit(const Stop&, int lane)  at each stop to be seen; false: seen enough
  ///   void ended(const PathResult&, int lane)
  /// and may ask in `visit` for the state and what follows from it; if it has `arrivals(const T&)`,
  /// that is called first, with 1 in each lane at a stop and 0 in the others. Allocates nothing.
  template <class Client>
  void run(Client& client) {
    for (int i = 0; i < kWidth; ++i) load(client, i);
    while (any_under_way()) {
      iterate();
      for (int i = 0; i < kWidth; ++i) {
        moves_[i] = courses_[i].under_way() ? courses_[i].after(reading(i)) : Move{};
      }
      believe();
      if constexpr (requires(T lanes) { client.arrivals(lanes); }) client.arrivals(arrivals());
      for (int i = 0; i < kWidth; ++i) {
        if (moves_[i].arrived) go_on(client, i);
        if (moves_[i].ended) {
          client.ended(courses_[i].result(), i);
          load(client, i);
        }
      }
      depart();
    }
  }

  /// The sheets of all lanes, and their states at the last points they found.
  const SheetGeometry<T>& geometry() const { return geometry_; }
  const FoldState<T>& state() const { return last_; }
  /// The state at the stop of a lane.
  void copy_state(int i, FoldState<double>& state) const { copy_lane(last_, i, state); }
  /// Its diagonals, panel widths.
  void copy_lengths(int i, double* lengths) const;
  /// Factors of the Jacobian there, but for the last correction (1e-12 / its singular values).
  const SparseLu<T>& factors() const { return lu_; }
  /// Change of its diagonals per radian of the pilot; returns how far the tangent is from one, the
  /// largest entry of J times it.
  double copy_slopes(int i, double* slopes);
  /// The pilot's entry of its unit tangent there: 0 at a fold limit.
  double pilot_rate(int i) const { return lane(tangents_[0][unknowns_ - 1], i); }

 private:
  template <class Client>
  void load(Client& client, int i) {
    moves_[i] = {};
    Departure departure{};
    if (!client.next(departure, i)) return;
    put(departure, i);
    courses_[i].begin(*departure.plan, departure.first_stop, departure.forward_sign);
  }

  template <class Client>
  void go_on(Client& client, int i) {
    const Stop& stop = courses_[i].target();
    if (stop.visit && !client.visit(stop, i)) {
      moves_[i] = courses_[i].stop();
    } else {
      moves_[i] = courses_[i].proceed();
    }
  }

  T arrivals() const {
    T arrived(0);
    for (int i = 0; i < kWidth; ++i) lane(arrived, i) = moves_[i].arrived ? 1 : 0;
    return arrived;
  }

  bool any_under_way() const {
    for (const Course& course : courses_) {
      if (course.under_way()) return true;
    }
    return false;
  }

  void put(const Departure& departure, int i);
  MISALIGN_FLATTEN void iterate();
  MISALIGN_FLATTEN void find_slopes();
  void solve();
  Reading reading(int i) const;
  MISALIGN_FLATTEN void believe();
  void depart();

  const Mechanism& mechanism_;
  const int unknowns_;
  SparseLu<T> lu_;
  SheetGeometry<T> geometry_;
  FoldState<T> trial_, last_, ahead_;
  std::vector<T> residual_, y_, correction_, null_, move_, lengths_, slopes_;
  std::array<std::vector<T>, 3> tangents_;  // newest first
  T open_, largest_correction_, misfit_, determinant_sign_, orientation_, cosine_,
      largest_half_sine_;
  bool slopes_known_ = false;
  std::array<Course, kWidth> courses_;
  std::array<Move, kWidth> moves_;
};

}  // namespace misalign::solver

#include "solver/continuation/path_follower_impl.hpp"
