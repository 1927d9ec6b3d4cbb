// Keeps the last solved states of one sheet in each lane, with their rates, and predicts states
// from them: by polynomials in the cosines and sines of half angles and in quaternions.
#pragma once

#include <array>
#include <vector>

#include "solver/continuation/step.hpp"
#include "solver/kinematics/lane_state.hpp"

namespace misalign::solver {

template <class T>
class NodeStates {
 public:
  /// Owns its memory from the start; `mechanism` must outlive it.
  explicit NodeStates(const Mechanism& mechanism)
      : mechanism_(mechanism),
        ahead_(flat_state<T>(mechanism)),
        tangent_(static_cast<std::size_t>(mechanism.unknowns), T(0)) {
    nodes_.fill({ahead_, ahead_, tangent_});
  }

  /// Keeps the newest node of lane i in its place `place`: its state, and its unit tangent times
  /// `tangent_sign`.
  void keep(int i, int place, double tangent_sign, const FoldState<T>& state,
            const std::vector<T>& tangent);
  /// Makes the node in `place` the newest again.
  void go_back(int i, int place) {
    const std::vector<T>& newest = nodes_[place].tangent;
    for (std::size_t j = 0; j < tangent_.size(); ++j) lane(tangent_[j], i) = lane(newest[j], i);
  }
  const FoldState<T>& state(int place) const { return nodes_[place].state; }
  /// Tangents of the newest nodes.
  const std::vector<T>& tangent() const { return tangent_; }

  /// Predicts the states of lanes that depart into ahead(), with their pilots not held. Returns
  /// false if none departs.
  MISALIGN_FLATTEN bool predict(const std::array<PathStep, kLanes<T>>& steps);
  const FoldState<T>& ahead() const { return ahead_; }
  /// Predicts the state of one lane; `state` has its size already.
  void find_state(int i, const PathStep& step, FoldState<double>& state) const;

 private:
  // Rates are per unit of arc length.
  struct Node {
    FoldState<T> state, rate;
    std::vector<T> tangent;
  };

  const Mechanism& mechanism_;
  std::array<Node, kStatePlaces> nodes_;  // by place, per lane
  FoldState<T> ahead_;
  std::vector<T> tangent_;
};

template <class T>
void NodeStates<T>::keep(int i, int place, double tangent_sign, const FoldState<T>& state,
                         const std::vector<T>& tangent) {
  Node& node = nodes_[place];
  const auto sign = static_cast<Scalar<T>>(tangent_sign);
  for (std::size_t j = 0; j < tangent.size(); ++j) {
    lane(node.tangent[j], i) = sign * lane(tangent[j], i);
  }
  go_back(i, place);
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
    const Quaternion<double> orientation{lane(q.w, i), lane(q.x, i), lane(q.y, i), lane(q.z, i)};
    const T* const turn = tangent_.data() + mechanism_.balls[k].column;
    const Quaternion<double> rate =
        Quaternion<double>{0, 0.5 * lane(turn[0], i), 0.5 * lane(turn[1], i),
                           0.5 * lane(turn[2], i)} *
        orientation;
    const auto put = [i](Quaternion<T>& to, const Quaternion<double>& from) {
      lane(to.w, i) = from.w;
      lane(to.x, i) = from.x;
      lane(to.y, i) = from.y;
      lane(to.z, i) = from.z;
    };
    put(node.state.balls[k], orientation);
    put(node.rate.balls[k], rate);
  }
}

template <class T>
void NodeStates<T>::find_state(int i, const PathStep& step, FoldState<double>& state) const {
  for (HalfAngle<double>& rho : state.creases) rho = {step.of_flat, 0};
  for (Quaternion<double>& q : state.balls) q = {step.of_flat, 0, 0, 0};
  for (int k = 0; k < kStatePlaces; ++k) {
    const double v = step.of_values[k], r = step.of_rates[k];
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

template <class T>
bool NodeStates<T>::predict(const std::array<PathStep, kLanes<T>>& steps) {
  using std::sqrt;
  T of_flat(0), of_values[kStatePlaces], of_rates[kStatePlaces];
  bool any = false;
  for (int i = 0; i < kLanes<T>; ++i) {
    lane(of_flat, i) = steps[i].of_flat;
    for (int k = 0; k < kStatePlaces; ++k) {
      lane(of_values[k], i) = steps[i].of_values[k];
      lane(of_rates[k], i) = steps[i].of_rates[k];
    }
    any = any || steps[i].depart;
  }
  if (!any) return false;
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
  return true;
}

}  // namespace misalign::solver
