// Follows the folding paths of sheets of one topology, one in each lane, each at its own angle; a
// lane takes the next sheet as soon as its path has ended. T = double, one path, is the definition:
// a lane has its bits, whatever its neighbours do.
//
// Predictor: the polynomial through the last nodes' states and tangents, in cosines and sines of
// half angles and in quaternions. Corrector: Newton's method with the pilot held, or along the
// shortest way to the curve (Moore-Penrose; Allgower & Georg, Introduction to Numerical
// Continuation Methods, ch. 3 and 6). The policy Steps chooses the step and the corrector:
// CloseSteps from station to station, LongSteps from node to node of a function. The policy Closure
// solves the equations.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/continuation/close_steps.hpp"
#include "solver/continuation/lane_corrector.hpp"
#include "solver/continuation/long_steps.hpp"
#include "solver/continuation/node_states.hpp"
#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {

/// A state that an observer of LongSteps requests: at a point of the newest segment, predicted from
/// the last nodes. `state` has its size already.
struct NearState {
  double x;
  FoldState<double>* state;
};

/// `Closure` is a SparseClosure<T>, or for T = double a PivotedClosure.
template <class T, class Steps = CloseSteps, class Closure = SparseClosure<T>>
class PathFollower {
 public:
  static constexpr int kWidth = kLanes<T>;
  using Options = typename Steps::Options;

  /// Owns its memory from the start; `mechanism` must outlive it.
  PathFollower(const Mechanism& mechanism, Closure closure, const Options& options = {});
  /// Uses an elimination in fixed order, which must outlive this object too.
  PathFollower(const Mechanism& mechanism, const Elimination& elimination,
               const Options& options = {})
      : PathFollower(mechanism, Closure(mechanism, elimination), options) {}

  /// Follows the paths of a queue, whose `bool next(PathStart&, int lane)` gives a lane its next
  /// path, or false if none is left. Allocates nothing. An observer has
  ///   bool see(const Station&, int lane)   at each station to be seen; false: seen enough
  ///   or, of LongSteps, ObserverResult see(const PathFunction&, int lane)   a new segment
  ///   void ended(const PathResult&, int lane)
  /// and optionally
  ///   void begin_path(PathStart&, int lane)   a path begins, which it may change
  ///   void arrivals(const T&)   before any `see`: 1 in each lane at a station, 0 in the others
  ///   PathPoint& point()   to be filled in at a station before `see`
  ///   bool wants_slopes()   in it too, which cost more than lengths
  ///   const std::vector<NearState>& near_states()   to be found after `see` and after `ended`
  template <class Queue, class Observer>
  void run(Queue& queue, Observer& observer) {
    go(observer, [&](PathStart& start, int lane) { return queue.next(start, lane); });
  }
  /// A single path.
  template <class Observer>
  void follow(const PathStart& path, Observer& observer) {
    const PathStart* left = &path;
    go(observer, [&](PathStart& start, int) {
      if (left) start = *left;
      return std::exchange(left, nullptr) != nullptr;
    });
  }

  const SheetGeometry<T>& geometry() const { return corrector_.geometry(); }
  /// States of all lanes: at a station, the solved ones.
  const FoldState<T>& state() const { return corrector_.trial(); }
  /// State of the newest node of lane i.
  const FoldState<T>& last_state(int i) const { return nodes_.state(place(i)); }
  /// Finds a near state of lane i (LongSteps).
  void find_state(const NearState& near, int i) const {
    nodes_.find_state(i, steps_[i].state_at(near.x), *near.state);
  }
  /// The equations at state(), up to the last correction (1e-12 / the Jacobian's singular values).
  const Closure& closure() const { return corrector_.closure(); }

 private:
  template <class Observer, class Next>
  void go(Observer& observer, const Next& next) {
    for (int i = 0; i < kWidth; ++i) load(observer, next, i);
    while (any_under_way()) {
      iterate();
      lengths_known_ = slopes_known_ = false;
      for (int i = 0; i < kWidth; ++i) {
        now_[i] = steps_[i].under_way() ? steps_[i].after(report(i)) : PathStep{};
      }
      if constexpr (requires(T lanes) { observer.arrivals(lanes); }) observer.arrivals(arrivals());
      for (int i = 0; i < kWidth; ++i) {
        if (now_[i].uncorrected) take_prediction(i);
        if (now_[i].keep) keep(i);
        if (now_[i].arrived) now_[i] = see(observer, i);
        if (now_[i].ended) {
          observer.ended(steps_[i].result(), i);
          find_near_states(observer, i);
          load(observer, next, i);
        }
      }
      predict();
    }
  }

  template <class Observer, class Next>
  void load(Observer& observer, const Next& next, int i) {
    now_[i] = {};
    PathStart start{};
    if (!next(start, i)) return;
    if constexpr (requires { observer.begin_path(start, i); }) observer.begin_path(start, i);
    corrector_.put(*start.geometry, *start.state, start.plan->stations[start.first_station].pilot,
                   i);
    steps_[i].begin(start);
  }

  template <class Observer>
  PathStep see(Observer& observer, int i) {
    Steps& steps = steps_[i];
    if constexpr (std::is_same_v<Steps, LongSteps>) {
      write_node(i);
      if (!steps.take()) return steps.take_back();
      keep(i);
      if (!steps.ends_segment()) return steps.proceed();
      const ObserverResult seen = observer.see(steps.function(), i);
      find_near_states(observer, i);
      if (seen == ObserverResult::enough) return steps.stop(PathEnd::stopped);
      if (seen == ObserverResult::lost) return steps.stop(PathEnd::stalled);
      if (seen == ObserverResult::go_on) return steps.proceed();
      const PathStep step = steps.take_back();
      if (steps.under_way()) nodes_.go_back(i, place(i));
      return step;
    } else {
      const Station& station = steps.target();
      if constexpr (requires { observer.point(); }) {
        if (station.visit) copy_point(i, observer.wants_slopes(), observer.point());
      }
      return station.visit && !observer.see(station, i) ? steps.stop() : steps.proceed();
    }
  }

  template <class Observer>
  void find_near_states(Observer& observer, int i) {
    if constexpr (std::is_same_v<Steps, LongSteps> && requires { observer.near_states(); }) {
      for (const NearState& near : observer.near_states()) find_state(near, i);
    }
  }

  T arrivals() const {
    T arrived(0);
    for (int i = 0; i < kWidth; ++i) lane(arrived, i) = now_[i].arrived ? 1 : 0;
    return arrived;
  }
  T free_lanes() const {
    T is_free(0);
    for (int i = 0; i < kWidth; ++i) lane(is_free, i) = steps_[i].is_free() ? 1 : 0;
    return is_free;
  }
  bool any_under_way() const {
    for (const Steps& steps : steps_) {
      if (steps.under_way()) return true;
    }
    return false;
  }

  static Steps steps_for(const Mechanism& mechanism, const Options& options) {
    if constexpr (std::is_same_v<Steps, LongSteps>) {
      return LongSteps(mechanism, options);
    } else {
      return CloseSteps(options);
    }
  }

  // Place of the newest node's state.
  int place(int i) const { return steps_[i].newest() % kStatePlaces; }
  MISALIGN_FLATTEN void iterate() { corrector_.iterate(free_lanes(), nodes_.tangent()); }
  NewtonReport report(int i) const;
  double largest_half_sine(int i) const;
  void take_prediction(int i);
  void keep(int i) {
    nodes_.keep(i, place(i), now_[i].tangent_sign, corrector_.trial(), corrector_.tangent());
  }
  void write_node(int i);
  void predict();
  MISALIGN_FLATTEN void find_lengths();
  MISALIGN_FLATTEN void find_slopes();
  void copy_point(int i, bool with_slopes, PathPoint& point);

  const Mechanism& mechanism_;
  const int unknowns_;
  LaneCorrector<T, Closure> corrector_;
  std::vector<Steps> steps_;
  std::array<PathStep, kWidth> now_;
  NodeStates<T> nodes_;
  std::vector<T> lengths_, slopes_, misfits_;
  T misfit_;
  bool lengths_known_ = false, slopes_known_ = false;
};

template <class T, class Steps, class Closure>
PathFollower<T, Steps, Closure>::PathFollower(const Mechanism& mechanism, Closure closure,
                                              const Options& options)
    : mechanism_(mechanism),
      unknowns_(mechanism.unknowns),
      corrector_(mechanism, std::move(closure)),
      steps_(kWidth, steps_for(mechanism, options)),
      nodes_(mechanism),
      lengths_(mechanism.diagonals.size(), T(0)),
      slopes_(lengths_),
      misfits_(mechanism.equations, T(0)) {}

template <class T, class Steps, class Closure>
NewtonReport PathFollower<T, Steps, Closure>::report(int i) const {
  const HalfAngle<T>& pilot = corrector_.trial().creases[mechanism_.pilot];
  NewtonReport report{lane(corrector_.open_by(), i),
                      lane(corrector_.largest_correction(), i),
                      lane(corrector_.orientation(), i) < 0 ? -1 : 1,
                      lane(corrector_.tangent()[unknowns_ - 1], i),
                      lane(corrector_.cosine(), i),
                      {lane(pilot.c, i), lane(pilot.s, i)}};
  if constexpr (std::is_same_v<Steps, CloseSteps>) {
    if (steps_[i].asks_for_turn(report.open_by)) report.largest_half_sine = largest_half_sine(i);
  }
  return report;
}

template <class T, class Steps, class Closure>
double PathFollower<T, Steps, Closure>::largest_half_sine(int i) const {
  if (steps_[i].newest() < 0) return 0;
  const FoldState<T>&now = corrector_.trial(), &last = last_state(i);
  double largest = 0;
  for (std::size_t k = 0; k < now.creases.size(); ++k) {
    const HalfAngle<T>&a = now.creases[k], &b = last.creases[k];
    largest = larger(largest, std::abs(lane(a.s, i) * lane(b.c, i) - lane(a.c, i) * lane(b.s, i)));
  }
  return largest;
}

// Takes the predicted state of lane i, without its last correction.
template <class T, class Steps, class Closure>
void PathFollower<T, Steps, Closure>::take_prediction(int i) {
  T chosen(0);
  lane(chosen, i) = 1;
  const HalfAngle<T> pilot = corrector_.trial().creases[mechanism_.pilot];
  replace(chosen, nodes_.ahead(), corrector_.trial());
  corrector_.hold({lane(pilot.c, i), lane(pilot.s, i)}, i);
}

template <class T, class Steps, class Closure>
void PathFollower<T, Steps, Closure>::write_node(int i) {
  if (!slopes_known_) find_slopes();
  PathFunction::Node& node = steps_[i].vacant();
  const double sign = now_[i].tangent_sign;
  const FoldState<T>& state = corrector_.trial();
  for (std::size_t k = 0; k < node.creases.size(); ++k) {
    node.creases[k] = {lane(state.creases[k].c, i), lane(state.creases[k].s, i)};
    node.crease_rates[k] = sign * lane(corrector_.tangent()[mechanism_.creases[k].column], i);
  }
  for (std::size_t d = 0; d < node.lengths.size(); ++d) {
    node.lengths[d] = lane(lengths_[d], i);
    node.slopes[d] = sign * lane(slopes_[d], i);
  }
  node.misfit = lane(misfit_, i);
}

// Puts the lanes that depart at their predicted states.
template <class T, class Steps, class Closure>
void PathFollower<T, Steps, Closure>::predict() {
  if (!nodes_.predict(now_)) return;
  T departs(0);
  for (int i = 0; i < kWidth; ++i) lane(departs, i) = now_[i].depart ? 1 : 0;
  replace(departs, nodes_.ahead(), corrector_.trial());
  for (int i = 0; i < kWidth; ++i) {
    if (now_[i].hold) corrector_.hold(now_[i].pilot, i);
  }
}

template <class T, class Steps, class Closure>
void PathFollower<T, Steps, Closure>::find_lengths() {
  folded_lengths(mechanism_, corrector_.geometry(), corrector_.trial(), lengths_.data());
  lengths_known_ = true;
}

template <class T, class Steps, class Closure>
void PathFollower<T, Steps, Closure>::find_slopes() {
  folded_lengths_and_slopes(mechanism_, corrector_.geometry(), corrector_.trial(),
                            corrector_.tangent().data(), lengths_.data(), slopes_.data(),
                            misfits_.data());
  misfit_ = T(0);
  for (const T& rest : misfits_) misfit_ = larger(misfit_, magnitude(rest));
  lengths_known_ = slopes_known_ = true;
}

// Copies a station's results; those that follow from the states are computed for all lanes at once,
// on first demand.
template <class T, class Steps, class Closure>
void PathFollower<T, Steps, Closure>::copy_point(int i, bool with_slopes, PathPoint& point) {
  copy_lane(corrector_.trial(), i, point.state);
  const double pilot_rate = lane(corrector_.tangent()[unknowns_ - 1], i);  // of either sign
  point.pilot_rate = std::abs(pilot_rate);
  if (with_slopes && !slopes_known_) find_slopes();
  if (!lengths_known_) find_lengths();
  for (std::size_t k = 0; k < lengths_.size(); ++k) point.lengths[k] = lane(lengths_[k], i);
  if (!with_slopes) return;
  for (std::size_t k = 0; k < slopes_.size(); ++k) {
    point.slopes[k] = lane(slopes_[k], i) / pilot_rate;
  }
  for (std::size_t j = 0; j < point.rates.size(); ++j) {
    point.rates[j] = lane(corrector_.tangent()[j], i) / pilot_rate;
  }
  point.misfit = lane(misfit_, i) / point.pilot_rate;
}

}  // namespace misalign::solver
