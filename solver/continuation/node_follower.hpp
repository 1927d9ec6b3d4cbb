// Folding paths as functions, of many sheets side by side, one in each lane: from node to node in
// long steps. Predictor: the polynomial through the last nodes' states and tangents, in cosines and
// sines of half angles and in quaternions. Corrector: Newton's method with the pilot held, or along
// the shortest way to the curve where the pilot slows down. NodeControl decides which, and how far.
#pragma once

#include <array>
#include <vector>

#include "solver/continuation/lane_corrector.hpp"
#include "solver/continuation/node_control.hpp"
#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {

template <class T>
class NodeFollower {
 public:
  static constexpr int kWidth = kLanes<T>;

  /// Owns its memory from the start; both must outlive it.
  NodeFollower(const Mechanism& mechanism, const Elimination& elimination,
               const NodeControlOptions& options = {})
      : mechanism_(mechanism),
        corrector_(mechanism, SparseClosure<T>(mechanism, elimination)),
        control_(mechanism, kWidth, options),
        ahead_(flat_state<T>(mechanism)),
        tangent_(mechanism.unknowns, T(0)),
        lengths_(mechanism.diagonals.size(), T(0)),
        slopes_(lengths_),
        misfits_(mechanism.equations, T(0)) {
    for (StateNode& node : nodes_) node = {ahead_, ahead_, tangent_};
  }

  /// Follows paths until `observer` has no more of them. It has
  ///   bool next(PathStart&, int lane)   the next path, for this lane; false: none is left
  ///   ObserverResult see(const PathFunction&, int lane)   a new segment
  ///   void ended(const PathResult&, int lane)
  /// Allocates nothing.
  template <class Observer>
  void run(Observer& observer) {
    for (int i = 0; i < kWidth; ++i) load(observer, i);
    while (any_under_way()) {
      T is_free(0);
      for (int i = 0; i < kWidth; ++i) lane(is_free, i) = control_.is_free(i) ? 1 : 0;
      iterate(is_free);
      bool any_arrived = false;
      for (int i = 0; i < kWidth; ++i) {
        steps_[i] = control_.under_way(i) ? control_.after(report(i), i) : NodeStep{};
        any_arrived = any_arrived || steps_[i].arrived;
      }
      if (any_arrived) find_slopes();
      for (int i = 0; i < kWidth; ++i) {
        if (steps_[i].arrived) steps_[i] = arrive(observer, i);
        if (steps_[i].ended) {
          observer.ended(control_.result(i), i);
          load(observer, i);
        }
      }
      predict();
    }
  }

  /// The path of this lane as it is known, and the determinant's sign on it.
  const PathFunction& function(int i) const { return control_.function(i); }
  int forward_sign(int i) const { return control_.forward_sign(i); }
  /// The state of this lane's sheet at a point of its newest segment, as the last nodes foretell
  /// it; `state` has its size already.
  void find_state(double x, int i, FoldState<double>& state) const;

 private:
  // A solved state, and its rates per unit of arc length.
  struct StateNode {
    FoldState<T> state, rate;
    std::vector<T> tangent;
  };

  template <class Observer>
  void load(Observer& observer, int i) {
    steps_[i] = {};
    PathStart start{};
    if (!observer.next(start, i)) return;
    corrector_.put(*start.geometry, *start.state, start.plan->stations[start.first_station].pilot,
                   i);
    control_.begin(start, i);
  }

  template <class Observer>
  NodeStep arrive(Observer& observer, int i) {
    write_node(i);
    if (!control_.take(i)) return control_.take_back(i);
    keep_state(i);
    if (control_.ends_segment(i)) {
      const ObserverResult seen = observer.see(control_.function(i), i);
      if (seen == ObserverResult::enough) return control_.stop(PathEnd::stopped, i);
      if (seen == ObserverResult::lost) return control_.stop(PathEnd::stalled, i);
      if (seen == ObserverResult::unsure) {
        const NodeStep step = control_.take_back(i);
        if (control_.under_way(i)) put_tangent(i);
        return step;
      }
    }
    return control_.proceed(i);
  }

  bool any_under_way() const {
    for (int i = 0; i < kWidth; ++i) {
      if (control_.under_way(i)) return true;
    }
    return false;
  }

  MISALIGN_FLATTEN void iterate(const T& is_free) { corrector_.iterate(is_free, tangent_); }
  MISALIGN_FLATTEN void find_slopes();
  MISALIGN_FLATTEN void predict();
  NewtonReport report(int i) const;
  void write_node(int i);
  void keep_state(int i);
  // Of the newest node.
  void put_tangent(int i) {
    const std::vector<T>& newest = nodes_[control_.place(i)].tangent;
    for (std::size_t j = 0; j < tangent_.size(); ++j) lane(tangent_[j], i) = lane(newest[j], i);
  }

  const Mechanism& mechanism_;
  LaneCorrector<T, SparseClosure<T>> corrector_;
  NodeControl control_;
  std::array<StateNode, kStatePlaces> nodes_;  // by place
  FoldState<T> ahead_;
  std::vector<T> tangent_;  // the newest node's
  std::vector<T> lengths_, slopes_, misfits_;
  T misfit_;
  std::array<NodeStep, kWidth> steps_;
};

template <class T>
NewtonReport NodeFollower<T>::report(int i) const {
  NewtonReport report{};
  report.open_by = lane(corrector_.open_by(), i);
  report.correction_rad = lane(corrector_.largest_correction(), i);
  report.determinant_sign = lane(corrector_.determinant_sign(), i) < 0 ? -1 : 1;
  report.orientation = lane(corrector_.orientation(), i) < 0 ? -1 : 1;
  report.tangent_pilot = lane(corrector_.tangent()[mechanism_.unknowns - 1], i);
  report.tangent_cosine = lane(corrector_.cosine(), i);
  return report;
}

template <class T>
void NodeFollower<T>::find_slopes() {
  folded_lengths_and_slopes(mechanism_, corrector_.geometry(), corrector_.trial(),
                            corrector_.tangent().data(), lengths_.data(), slopes_.data(),
                            misfits_.data());
  misfit_ = T(0);
  for (const T& rest : misfits_) misfit_ = larger(misfit_, magnitude(rest));
}

template <class T>
void NodeFollower<T>::write_node(int i) {
  PathNode& node = control_.vacant(i);
  const double sign = control_.tangent_sign(i);
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

template <class T>
void NodeFollower<T>::keep_state(int i) {
  StateNode& node = nodes_[control_.place(i)];
  const FoldState<T>& state = corrector_.trial();
  const double sign = control_.tangent_sign(i);
  for (std::size_t j = 0; j < tangent_.size(); ++j) {
    lane(node.tangent[j], i) = sign * lane(corrector_.tangent()[j], i);
  }
  put_tangent(i);
  for (std::size_t k = 0; k < state.creases.size(); ++k) {
    const double c = lane(state.creases[k].c, i), s = lane(state.creases[k].s, i);
    const double half = 0.5 * lane(tangent_[mechanism_.creases[k].column], i);
    lane(node.state.creases[k].c, i) = c;
    lane(node.state.creases[k].s, i) = s;
    lane(node.rate.creases[k].c, i) = -s * half;
    lane(node.rate.creases[k].s, i) = c * half;
  }
  for (std::size_t k = 0; k < state.balls.size(); ++k) {
    const Quaternion<T>& q = state.balls[k];
    const Quaternion<double> here{lane(q.w, i), lane(q.x, i), lane(q.y, i), lane(q.z, i)};
    const T* const turn = tangent_.data() + mechanism_.balls[k].column;
    const Quaternion<double> rate =
        Quaternion<double>{0, 0.5 * lane(turn[0], i), 0.5 * lane(turn[1], i),
                           0.5 * lane(turn[2], i)} *
        here;
    const auto put = [i](Quaternion<T>& to, const Quaternion<double>& from) {
      lane(to.w, i) = from.w;
      lane(to.x, i) = from.x;
      lane(to.y, i) = from.y;
      lane(to.z, i) = from.z;
    };
    put(node.state.balls[k], here);
    put(node.rate.balls[k], rate);
  }
}

template <class T>
void NodeFollower<T>::find_state(double x, int i, FoldState<double>& state) const {
  const NodeStep weights = control_.state_at(x, i);
  for (HalfAngle<double>& rho : state.creases) rho = {weights.of_flat, 0};
  for (Quaternion<double>& q : state.balls) q = {weights.of_flat, 0, 0, 0};
  for (int k = 0; k < kStatePlaces; ++k) {
    const double v = weights.of_values[k], r = weights.of_rates[k];
    if (v == 0 && r == 0) continue;
    for (std::size_t j = 0; j < state.creases.size(); ++j) {
      const HalfAngle<T>&at = nodes_[k].state.creases[j], &rate = nodes_[k].rate.creases[j];
      state.creases[j].c += v * lane(at.c, i) + r * lane(rate.c, i);
      state.creases[j].s += v * lane(at.s, i) + r * lane(rate.s, i);
    }
    for (std::size_t j = 0; j < state.balls.size(); ++j) {
      const Quaternion<T>&at = nodes_[k].state.balls[j], &rate = nodes_[k].rate.balls[j];
      Quaternion<double>& q = state.balls[j];
      q.w += v * lane(at.w, i) + r * lane(rate.w, i);
      q.x += v * lane(at.x, i) + r * lane(rate.x, i);
      q.y += v * lane(at.y, i) + r * lane(rate.y, i);
      q.z += v * lane(at.z, i) + r * lane(rate.z, i);
    }
  }
  for (HalfAngle<double>& rho : state.creases) rho = rho.turned(0);
  for (Quaternion<double>& q : state.balls) q = q.normalized();
}

// Sets the lanes that depart on their way.
template <class T>
void NodeFollower<T>::predict() {
  using std::sqrt;
  T departs(0), of_flat(0), of_values[kStatePlaces], of_rates[kStatePlaces];
  bool any = false;
  for (int i = 0; i < kWidth; ++i) {
    lane(departs, i) = steps_[i].depart ? 1 : 0;
    lane(of_flat, i) = steps_[i].of_flat;
    for (int k = 0; k < kStatePlaces; ++k) {
      lane(of_values[k], i) = steps_[i].of_values[k];
      lane(of_rates[k], i) = steps_[i].of_rates[k];
    }
    any = any || steps_[i].depart;
  }
  if (!any) return;
  for (std::size_t j = 0; j < ahead_.creases.size(); ++j) {
    T c = of_flat, s(0);
    for (int k = 0; k < kStatePlaces; ++k) {
      const HalfAngle<T>&at = nodes_[k].state.creases[j], &rate = nodes_[k].rate.creases[j];
      c = c + of_values[k] * at.c + of_rates[k] * rate.c;
      s = s + of_values[k] * at.s + of_rates[k] * rate.s;
    }
    const T scale = T(1) / sqrt(c * c + s * s);
    ahead_.creases[j] = {c * scale, s * scale};
  }
  for (std::size_t j = 0; j < ahead_.balls.size(); ++j) {
    Quaternion<T> q{of_flat, T(0), T(0), T(0)};
    for (int k = 0; k < kStatePlaces; ++k) {
      const Quaternion<T>&at = nodes_[k].state.balls[j], &rate = nodes_[k].rate.balls[j];
      q = {q.w + of_values[k] * at.w + of_rates[k] * rate.w,
           q.x + of_values[k] * at.x + of_rates[k] * rate.x,
           q.y + of_values[k] * at.y + of_rates[k] * rate.y,
           q.z + of_values[k] * at.z + of_rates[k] * rate.z};
    }
    ahead_.balls[j] = q.normalized();
  }
  replace(departs, ahead_, corrector_.trial());
  for (int i = 0; i < kWidth; ++i) {
    if (steps_[i].hold) corrector_.hold(steps_[i].pilot, i);
  }
}

}  // namespace misalign::solver
