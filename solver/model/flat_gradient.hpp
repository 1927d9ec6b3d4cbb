// Computes gradients of a folded sheet by the flat places of its vertices, by the adjoint of loop
// closure: all vertices together cost one transposed solve.
//
// A vertex enters a joint of a closed state in two ways. A joint's fixed point that moves by d
// moves what follows it by (R_before - R_after) d. An edge that turns in the sheet turns the crease
// on it: by the screw (R_before - R_after) z through the same point. The end of a spring moves with
// the corner of its panel. A wrench (force f, moment m about the origin) has with a screw (w, c)
// the power w . (m - c x f); a diagonal is such a wrench on the joints between its ends, and a
// weight of the closure equations one on all joints of the loop.
#pragma once

#include <vector>

#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/lane_math.hpp"
#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {

template <class T>
class FlatGradient {
 public:
  /// `mechanism` must outlive this object.
  explicit FlatGradient(const Mechanism& mechanism) : mechanism_(mechanism) {
    for (const Loop& loop : mechanism.loops) {
      first_joint_.push_back(joints_.size());
      joints_.resize(joints_.size() + loop.passages.size());
    }
    corners_.resize(mechanism.loops.size());
    rates_.assign(mechanism.unknowns, T(0));
    weights_.assign(mechanism.equations, T(0));
    work_ = weights_;
  }

  /// Prepares gradients at a closed state. `geometry` must live as long as they are computed.
  void at(const SheetGeometry<T>& geometry, const FoldState<T>& state) {
    geometry_ = &geometry;
    for (std::size_t i = 0; i < mechanism_.loops.size(); ++i) look_at(i, state);
  }

  /// Length of a diagonal, panel widths, as folded_lengths() has it.
  T length(int diagonal) const {
    const Diagonal& d = mechanism_.diagonals[diagonal];
    return distance(corners_[d.loop][d.from_corner].point, corners_[d.loop][d.to_corner].point);
  }

  /// d length / d unknown of a diagonal, one per unknown.
  void of_unknowns(int diagonal, T* rates) const {
    for (int j = 0; j < mechanism_.unknowns; ++j) rates[j] = T(0);
    const Wrench from_end = pull(diagonal, true), to_end = pull(diagonal, false);
    each_joint_of(diagonal, [&](const Joint& joint, bool before_from, bool before_to) {
      Wrench wrench{};
      if (before_from) wrench = wrench + from_end;
      if (before_to) wrench = wrench + to_end;
      for (int k = 0; k < joint.count; ++k) {
        T& rate = rates[joint.column + k];
        rate = rate + joint.unknown[k].power(wrench);
      }
    });
  }

  /// d length / d vertex (x and y of each vertex in turn) with the pilot held, by the factors of
  /// the Jacobian at this state.
  void with_pilot_held(int diagonal, const SparseLu<T>& factors, std::vector<T>& gradient) {
    of_unknowns(diagonal, rates_.data());
    add_held(diagonal, factors, gradient);
  }
  /// d length / d vertex with the level held: the sum of unknowns weighted by `level`, which
  /// `tangent` changes by 1.
  void with_level_held(int diagonal, const SparseLu<T>& factors, const std::vector<T>& level,
                       const std::vector<T>& tangent, std::vector<T>& gradient) {
    of_unknowns(diagonal, rates_.data());
    T slope(0);
    for (std::size_t j = 0; j < rates_.size(); ++j) slope = slope + rates_[j] * tangent[j];
    for (std::size_t j = 0; j < rates_.size(); ++j) rates_[j] = rates_[j] - slope * level[j];
    add_held(diagonal, factors, gradient);
  }

  /// Adds the diagonal's own d length / d vertex (x and y of each vertex in turn), its joints held.
  void add_length(int diagonal, T* gradient) const {
    const Wrench from_end = pull(diagonal, true), to_end = pull(diagonal, false);
    const Diagonal& d = mechanism_.diagonals[diagonal];
    add_corner(d.loop, d.from_corner, from_end.force, gradient);
    add_corner(d.loop, d.to_corner, to_end.force, gradient);
    each_joint_of(diagonal, [&](const Joint& joint, bool before_from, bool before_to) {
      Wrench wrench{};
      if (before_from) wrench = wrench + from_end;
      if (before_to) wrench = wrench + to_end;
      add_joint(joint, wrench, gradient);
    });
  }

  /// Adds d (weights . closure) / d vertex, weights one per equation, its joints held.
  void add_closure(const T* weights, T* gradient) const {
    for (std::size_t i = 0; i < mechanism_.loops.size(); ++i) {
      const Loop& loop = mechanism_.loops[i];
      const T* w = weights + loop.first_row;
      Wrench wrench{};
      wrench.moment = {w[0], w[1], w[2]};
      if (loop.rows == 6) wrench.force = {w[3], w[4], w[5]};
      for (std::size_t k = 0; k < loop.passages.size(); ++k) {
        add_joint(joints_[first_joint_[i] + k], wrench, gradient);
      }
    }
  }

 private:
  struct Wrench {
    Vec3<T> force{T(0), T(0), T(0)}, moment{T(0), T(0), T(0)};
    friend Wrench operator+(const Wrench& a, const Wrench& b) {
      return {a.force + b.force, a.moment + b.moment};
    }
  };
  struct Screw {
    Vec3<T> axis, arm;  // w, and w x c
    T power(const Wrench& wrench) const {
      return dot(axis, wrench.moment) - dot(arm, wrench.force);
    }
  };
  struct Joint {
    std::array<Screw, 3> unknown;
    int count, column;
    Vec3<T> along_x, along_y;  // motion of what follows per motion of the fixed point
    Screw edge_end;    // its motion per motion of the edge's end across the edge, per edge length
    int vertex, edge;  // edge: -1 for a ball joint
  };
  struct Corner {
    Vec3<T> point;
    Mat3<T> frame;
  };
  void look_at(std::size_t i, const FoldState<T>& state) {
    const Loop& loop = mechanism_.loops[i];
    Pose<T> pose = Pose<T>::identity();
    int corner = 0;
    const int passages = static_cast<int>(loop.passages.size());
    for (int next = 0;; ++next) {
      for (; loop.hole >= 0 && corner < 4 && loop.carriers[corner].arrival == next; ++corner) {
        corners_[i][corner] = {pose * spring_end(mechanism_, *geometry_, loop, corner),
                               pose.rotation};
      }
      if (next == passages) break;
      const Passage& passage = loop.passages[next];
      const Pose<T> before = pose;
      pose = pose.then_rotate(passage_rotation(mechanism_, *geometry_, state, passage),
                              flat_point(*geometry_, passage.vertex));
      detail::LoopScrews<T> screws;
      detail::gather(mechanism_, *geometry_, passage, before, pose, screws);
      Joint& joint = joints_[first_joint_[i] + next];
      joint.count = screws.count;
      joint.column = mechanism_.first_column(passage);
      for (int k = 0; k < screws.count; ++k) {
        joint.unknown[k] = {screws.axis[k], cross(screws.axis[k], screws.point[k])};
      }
      joint.along_x = before.rotation.cx - pose.rotation.cx;
      joint.along_y = before.rotation.cy - pose.rotation.cy;
      joint.vertex = passage.vertex;
      joint.edge = passage.ball ? -1 : mechanism_.creases[passage.joint].edge;
      if (passage.ball) continue;
      const Vec3<T> along = along_edge(joint.edge);
      const Vec3<T> axis = (T(1) / dot(along, along)) * (before.rotation.cz - pose.rotation.cz);
      joint.edge_end = {axis, cross(axis, screws.point[0])};
    }
  }

  Vec3<T> along_edge(int edge) const {
    return flat_point(*geometry_, mechanism_.edges[edge].b) -
           flat_point(*geometry_, mechanism_.edges[edge].a);
  }

  // Adds the gradient whose derivatives by the free unknowns are rates_.
  void add_held(int diagonal, const SparseLu<T>& factors, std::vector<T>& gradient) {
    factors.transposed(rates_.data(), work_.data(), weights_.data());
    for (T& weight : weights_) weight = -weight;
    for (T& entry : gradient) entry = T(0);
    add_length(diagonal, gradient.data());
    add_closure(weights_.data(), gradient.data());
  }

  // Wrench by which a diagonal pulls at its `from` corner, or at the other.
  Wrench pull(int diagonal, bool from) const {
    const Diagonal& d = mechanism_.diagonals[diagonal];
    const Vec3<T>& a = corners_[d.loop][d.from_corner].point;
    const Vec3<T>& b = corners_[d.loop][d.to_corner].point;
    const Vec3<T> force = (T(from ? 1 : -1) / distance(a, b)) * (a - b);
    return {force, cross(from ? a : b, force)};
  }

  // Visits the joints of a diagonal's loop with whether each comes before the corner where it
  // begins or ends.
  template <class Work>
  void each_joint_of(int diagonal, const Work& work) const {
    const Diagonal& d = mechanism_.diagonals[diagonal];
    const Loop& loop = mechanism_.loops[d.loop];
    const int from = loop.carriers[d.from_corner].arrival, to = loop.carriers[d.to_corner].arrival;
    for (int k = 0; k < std::max(from, to); ++k) {
      work(joints_[first_joint_[d.loop] + k], k < from, k < to);
    }
  }

  // Adds the gradient of a force on a spring's end, with joints held.
  void add_corner(int loop, int corner, const Vec3<T>& force, T* gradient) const {
    const Mat3<T>& frame = corners_[loop][corner].frame;
    add_end(mechanism_, *geometry_, mechanism_.loops[loop], corner,
            {dot(frame.cx, force), dot(frame.cy, force), T(0)}, gradient);
  }

  static void add_at(int vertex, const T& x, const T& y, T* gradient) {
    gradient[2 * vertex] = gradient[2 * vertex] + x;
    gradient[2 * vertex + 1] = gradient[2 * vertex + 1] + y;
  }

  void add_joint(const Joint& joint, const Wrench& wrench, T* gradient) const {
    add_at(joint.vertex, dot(joint.along_x, wrench.force), dot(joint.along_y, wrench.force),
           gradient);
    if (joint.edge < 0) return;
    const Edge& edge = mechanism_.edges[joint.edge];
    const Vec3<T> along = along_edge(joint.edge);
    const T share = joint.edge_end.power(wrench);
    add_at(edge.b, -(share * along.y), share * along.x, gradient);
    add_at(edge.a, share * along.y, -(share * along.x), gradient);
  }

  const Mechanism& mechanism_;
  const SheetGeometry<T>* geometry_ = nullptr;
  std::vector<std::size_t> first_joint_;  // per loop
  std::vector<Joint> joints_;
  std::vector<std::array<Corner, 4>> corners_;  // per loop
  std::vector<T> rates_, weights_, work_;
};

}  // namespace misalign::solver
