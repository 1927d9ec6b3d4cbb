// The folding paths of many sheets of one topology side by side, one in each lane, each at its own
// angle; a lane takes the next sheet as soon as its own path has ended. With T = double it follows
// one path, and that is the definition: a lane has its bits, whatever its neighbours do.
//
// Predictor: along the last three tangents (Adams-Bashforth). Corrector: Newton's method with the
// pilot held. Where that fails or leaves this half of the curve, the lane goes along the arc: Euler
// predictor, Moore-Penrose corrector (Allgower & Georg, Introduction to Numerical Continuation
// Methods, ch. 3 and 6). StepControl decides which; the policy Closure solves the linear equations.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/continuation/lane_corrector.hpp"
#include "solver/continuation/step_control.hpp"
#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {

/// `Closure` is a SparseClosure<T>, or for T = double a DenseClosure.
template <class T, class Closure = SparseClosure<T>>
class PathFollower {
 public:
  static constexpr int kWidth = kLanes<T>;

  /// Owns its memory from the start; `mechanism` must outlive it.
  PathFollower(const Mechanism& mechanism, Closure closure, const StepControlOptions& options = {});
  /// By an elimination in its fixed order, which must outlive this object too.
  PathFollower(const Mechanism& mechanism, const Elimination& elimination,
               const StepControlOptions& options = {})
      : PathFollower(mechanism, Closure(mechanism, elimination), options) {}

  /// Follows paths until `observer` has no more of them. It has
  ///   bool next(PathStart&, int lane)   the next path, for this lane; false: none is left
  ///   bool see(const Station&, int lane)   at each station to be seen; false: seen enough
  ///   void ended(const PathResult&, int lane)
  /// If it has `PathPoint& point()`, what was found at the station is there when it is told to see;
  /// slopes, which cost more than lengths, if its `wants_slopes()`. If it has `arrivals(const T&)`,
  /// that is called before any `see`, with 1 in each lane at a station and 0 in the others.
  /// Allocates nothing.
  template <class Observer>
  void run(Observer& observer) {
    for (int i = 0; i < kWidth; ++i) load(observer, i);
    while (any_under_way()) {
      iterate();
      for (int i = 0; i < kWidth; ++i) {
        steps_[i] = controls_[i].under_way() ? controls_[i].after(report(i)) : PathStep{};
      }
      believe();
      if constexpr (requires(T lanes) { observer.arrivals(lanes); }) observer.arrivals(arrivals());
      for (int i = 0; i < kWidth; ++i) {
        if (steps_[i].arrived) go_on(observer, i);
        if (steps_[i].ended) {
          observer.ended(controls_[i].result(), i);
          load(observer, i);
        }
      }
      predict();
    }
  }

  /// The sheets of all lanes, and their states at the last points they found.
  const SheetGeometry<T>& geometry() const { return corrector_.geometry(); }
  const FoldState<T>& state() const { return last_; }
  /// The equations there, but for the last correction (1e-12 / the Jacobian's singular values).
  const Closure& closure() const { return corrector_.closure(); }

 private:
  template <class Observer>
  void load(Observer& observer, int i) {
    steps_[i] = {};
    PathStart start{};
    if (!observer.next(start, i)) return;
    put(start, i);
    controls_[i].begin(*start.plan, start.first_station, start.forward_sign);
  }

  template <class Observer>
  void go_on(Observer& observer, int i) {
    const Station& station = controls_[i].target();
    if constexpr (requires { observer.point(); }) {
      if (station.visit) copy_point(i, observer.wants_slopes(), observer.point());
    }
    if (station.visit && !observer.see(station, i)) {
      steps_[i] = controls_[i].stop();
    } else {
      steps_[i] = controls_[i].proceed();
    }
  }

  T arrivals() const {
    T arrived(0);
    for (int i = 0; i < kWidth; ++i) lane(arrived, i) = steps_[i].arrived ? 1 : 0;
    return arrived;
  }

  bool any_under_way() const {
    for (const StepControl& control : controls_) {
      if (control.under_way()) return true;
    }
    return false;
  }

  void put(const PathStart& start, int i);
  MISALIGN_FLATTEN void iterate();
  NewtonReport report(int i) const;
  MISALIGN_FLATTEN void believe();
  void predict();
  MISALIGN_FLATTEN void find_lengths();
  MISALIGN_FLATTEN void find_slopes();
  void copy_point(int i, bool with_slopes, PathPoint& point);

  const Mechanism& mechanism_;
  const int unknowns_;
  LaneCorrector<T, Closure> corrector_;
  FoldState<T> last_, ahead_;
  std::vector<T> move_, lengths_, slopes_, misfits_;
  std::array<std::vector<T>, 3> tangents_;  // newest first
  T misfit_, largest_half_sine_;
  bool lengths_known_ = false, slopes_known_ = false;
  std::array<StepControl, kWidth> controls_;
  std::array<PathStep, kWidth> steps_;
};

template <class T, class Closure>
PathFollower<T, Closure>::PathFollower(const Mechanism& mechanism, Closure closure,
                                       const StepControlOptions& options)
    : mechanism_(mechanism),
      unknowns_(mechanism.unknowns),
      corrector_(mechanism, std::move(closure)),
      last_(flat_state<T>(mechanism)),
      ahead_(last_),
      move_(mechanism.unknowns, T(0)),
      lengths_(mechanism.diagonals.size(), T(0)),
      slopes_(lengths_),
      misfits_(mechanism.equations, T(0)),
      tangents_{move_, move_, move_} {
  controls_.fill(StepControl(options));
}

template <class T, class Closure>
void PathFollower<T, Closure>::put(const PathStart& start, int i) {
  corrector_.put(*start.geometry, *start.state, start.plan->stations[start.first_station].pilot, i);
  put_lane(*start.state, last_, i);
}

// One Newton iteration of every lane, and what its step control wants to know.
template <class T, class Closure>
void PathFollower<T, Closure>::iterate() {
  T on_arc(0);
  for (int i = 0; i < kWidth; ++i) lane(on_arc, i) = controls_[i].on_arc() ? 1 : 0;
  corrector_.iterate(on_arc, tangents_[0]);
  const FoldState<T>& trial = corrector_.trial();
  largest_half_sine_ = T(0);
  for (std::size_t k = 0; k < trial.creases.size(); ++k) {
    largest_half_sine_ = larger(largest_half_sine_,
                                magnitude(half_sine_between(trial.creases[k], last_.creases[k])));
  }
}

template <class T, class Closure>
NewtonReport PathFollower<T, Closure>::report(int i) const {
  const auto pilot_of = [&](const FoldState<T>& state) {
    const HalfAngle<T>& pilot = state.creases[mechanism_.pilot];
    return HalfAngle<double>{lane(pilot.c, i), lane(pilot.s, i)};
  };
  return {lane(corrector_.open_by(), i),
          lane(corrector_.largest_correction(), i),
          lane(corrector_.determinant_sign(), i) < 0 ? -1 : 1,
          lane(corrector_.orientation(), i) < 0 ? -1 : 1,
          lane(corrector_.tangent()[unknowns_ - 1], i),
          lane(corrector_.cosine(), i),
          lane(largest_half_sine_, i),
          pilot_of(last_),
          pilot_of(corrector_.trial())};
}

// Keeps the states, tangents and diagonals of the lanes that found a point of their curve.
template <class T, class Closure>
void PathFollower<T, Closure>::believe() {
  T believed(0), sign(1);
  bool any = false;
  for (int i = 0; i < kWidth; ++i) {
    lane(believed, i) = steps_[i].believe ? 1 : 0;
    lane(sign, i) = steps_[i].tangent_sign;
    any = any || steps_[i].believe;
  }
  if (!any) return;
  replace(believed, corrector_.trial(), last_);
  const auto chosen = believed > T(0);
  for (int j = 0; j < unknowns_; ++j) {
    tangents_[2][j] = select(chosen, tangents_[1][j], tangents_[2][j]);
    tangents_[1][j] = select(chosen, tangents_[0][j], tangents_[1][j]);
    tangents_[0][j] = select(chosen, sign * corrector_.tangent()[j], tangents_[0][j]);
  }
  lengths_known_ = slopes_known_ = false;
}

// Sets the lanes that depart on their way: `last` moved along the tangents. A turn by d is entered
// as 2 tan(d / 2), to third order, because `advance` turns by 2 atan of half its entry.
template <class T, class Closure>
void PathFollower<T, Closure>::predict() {
  T departs(0), along[3] = {T(0), T(0), T(0)};
  bool any = false;
  for (int i = 0; i < kWidth; ++i) {
    lane(departs, i) = steps_[i].depart ? 1 : 0;
    for (int k = 0; k < 3; ++k) lane(along[k], i) = steps_[i].along[k];
    any = any || steps_[i].depart;
  }
  if (!any) return;
  for (int j = 0; j < unknowns_; ++j) {
    const T turn =
        along[0] * tangents_[0][j] + along[1] * tangents_[1][j] + along[2] * tangents_[2][j];
    move_[j] = turn + turn * turn * turn * T(1.0 / 12);
  }
  ahead_ = last_;
  advance(mechanism_, move_.data(), ahead_);
  replace(departs, ahead_, corrector_.trial());
  for (int i = 0; i < kWidth; ++i) {
    if (steps_[i].hold) corrector_.hold(steps_[i].pilot, i);
  }
}

template <class T, class Closure>
void PathFollower<T, Closure>::find_lengths() {
  folded_lengths(mechanism_, corrector_.geometry(), last_, lengths_.data());
  lengths_known_ = true;
}

template <class T, class Closure>
void PathFollower<T, Closure>::find_slopes() {
  folded_lengths_and_slopes(mechanism_, corrector_.geometry(), last_, tangents_[0].data(),
                            lengths_.data(), slopes_.data(), misfits_.data());
  misfit_ = T(0);
  for (const T& rest : misfits_) misfit_ = larger(misfit_, magnitude(rest));
  lengths_known_ = slopes_known_ = true;
}

// What follows from the states is found for all lanes at once, on first demand.
template <class T, class Closure>
void PathFollower<T, Closure>::copy_point(int i, bool with_slopes, PathPoint& point) {
  copy_lane(last_, i, point.state);
  point.pilot_rate = lane(tangents_[0][unknowns_ - 1], i);
  if (with_slopes && !slopes_known_) find_slopes();
  if (!lengths_known_) find_lengths();
  for (std::size_t k = 0; k < lengths_.size(); ++k) point.lengths[k] = lane(lengths_[k], i);
  if (!with_slopes) return;
  for (std::size_t k = 0; k < slopes_.size(); ++k) {
    point.slopes[k] = lane(slopes_[k], i) / point.pilot_rate;
  }
  point.misfit = lane(misfit_, i) / point.pilot_rate;
}

}  // namespace misalign::solver
