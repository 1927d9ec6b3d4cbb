// Loop closure for proofs: of degree one in every unknown, and regular at flat.
//
// Every joint is a quaternion that is affine in its own unknowns and need not have length one: a
// loop's rotation is the identity where the vector part of the product is zero (and nowhere else: a
// half turn has the vector part of length one). Round a hole with corners p_k, whose sides e_k =
// p_(k+1) - p_k belong to facets turned by Q_k, the sides close: sum Q_k e_k = 0, hence, as they do
// on the flat sheet, sum (Q_k e_k - e_k) = 0. These are (3.1), (3.4) and (3.5) of the paper, all
// graded (graded.hpp), in another form than in loop_closure.hpp.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "solver/certificate/dual.hpp"
#include "solver/certificate/graded.hpp"
#include "solver/certificate/graded_spring.hpp"
#include "solver/certificate/taylor_model.hpp"
#include "solver/kinematics/folded_shape.hpp"

namespace misalign::solver {

/// Coordinates of the joints, whose unknowns x are all 0 in the middle of an interval. Coefficients
/// are exact, whatever their origin.
struct Chart {
  struct Crease {
    double c, c_rate, s,
        s_rate;  ///< q = (c + c_rate x) - sense (s + s_rate x) u, u the crease's axis
  };
  struct Ball {
    GradedQuaternion<double> middle;
    std::array<GradedQuaternion<double>, 3> rate;
  };
  std::vector<Crease> creases;
  std::vector<Ball> balls;
};

template <class T, class Sigma>
class GradedClosure {
 public:
  using Number = T;
  /// A joint at its unknowns: the quaternion of a passage of sense +1; a crease's lacks the axis.
  struct Joint {
    GradedQuaternion<T> q;  ///< a crease has w = c and x = s
    T inverse;              ///< 1 / |q|^2
  };

  /// All must outlive this object. `x` has all unknowns, the pilot's last.
  GradedClosure(const Mechanism& mechanism, const SheetGeometry<T>& geometry, const Chart& chart,
                const Sigma& sigma, const T* x)
      : mechanism_(mechanism), geometry_(geometry), chart_(chart), sigma_(sigma) {
    for (std::size_t i = 0; i < chart.creases.size(); ++i) {
      const Chart::Crease& at = chart.creases[i];
      const T& turn = x[mechanism.creases[i].column];
      const T c = T(at.c) + at.c_rate * turn, s = T(at.s) + at.s_rate * turn;
      creases_.push_back({{c, s, T(0.0), T(0.0)}, reciprocal(c * c + sigma(s * s))});
    }
    for (std::size_t i = 0; i < chart.balls.size(); ++i) {
      const Chart::Ball& at = chart.balls[i];
      const T* turn = x + mechanism.balls[i].column;
      GradedQuaternion<T> q{T(at.middle.w), T(at.middle.x), T(at.middle.y), T(at.middle.z)};
      for (int k = 0; k < 3; ++k) {
        q.w += at.rate[k].w * turn[k];
        q.x += at.rate[k].x * turn[k];
        q.y += at.rate[k].y * turn[k];
        q.z += at.rate[k].z * turn[k];
      }
      balls_.push_back({q, reciprocal(squared_norm(sigma, q))});
    }
  }

  /// Evaluates the residual, one for each equation, and unless `values` is null the Jacobian's
  /// structural nonzeros in the order of jacobian_entries, without those of the pilot.
  void evaluate(T* residual, std::vector<T>* values) const {
    if (values != nullptr) values->clear();
    for (const Loop& loop : mechanism_.loops) {
      const Walk walk = walk_round(loop);
      const GradedQuaternion<T>& whole = walk.before.back();
      T* row = residual + loop.first_row;
      row[0] = whole.x;
      row[1] = whole.y;
      row[2] = whole.z;
      if (loop.rows == 6) {
        GradedVector<T> sum = walk.displaced[0];
        for (int k = 1; k < 3; ++k) sum = plus(sum, walk.displaced[k]);
        row[3] = sum.x;
        row[4] = sum.y;
        row[5] = sum.z;
      }
      if (values != nullptr) {
        for (std::size_t j = 0; j < loop.passages.size(); ++j)
          write_columns(loop, walk, j, *values);
      }
    }
  }

  /// Change of a diagonal's squared length from the flat sheet, divided by sigma (panel widths
  /// squared): 2 e_1 . (R e_2 - e_2), with R the rotation of the joints at the corner between the
  /// two sides that it spans. It depends on these alone.
  T squared_elongation(const Diagonal& diagonal) const {
    if (!mechanism_.springs.at_vertices())
      return GradedSpring<GradedClosure>(*this, diagonal).stretch();
    const Loop& loop = mechanism_.loops[diagonal.loop];
    const Corner corner = go_round_corner(loop, middle_corner(diagonal));
    const GradedVector<T> before = side(loop, diagonal.from_corner);
    return 2.0 * (before.x * corner.displaced.x + before.y * corner.displaced.y);
  }

  /// Its derivative by each unknown of that corner's joints: use(column, derivative).
  template <class Use>
  void squared_elongation_rates(const Diagonal& diagonal, Use&& use) const {
    if (!mechanism_.springs.at_vertices())
      return GradedSpring<GradedClosure>(*this, diagonal).rates(use);
    const Loop& loop = mechanism_.loops[diagonal.loop];
    const int at = middle_corner(diagonal);
    const Corner corner = go_round_corner(loop, at);
    const GradedVector<T> before = side(loop, diagonal.from_corner);
    const GradedVector<T> after = moved(sigma_, side(loop, at), corner.displaced);
    for (std::size_t j = 0; j < corner.before.size(); ++j) {
      const Passage& passage = loop.passages[static_cast<std::size_t>(loop.arrival[at]) + j];
      for (int unknown = 0; unknown < (passage.ball ? 3 : 1); ++unknown) {
        const GradedVector<T> w =
            turning_from(passage, unknown, corner.before[j], corner.inverse[j]);
        const T x = w.y * after.z - w.z * after.y, y = w.z * after.x - w.x * after.z;
        use(mechanism_.first_column(passage) + unknown, 4.0 * (before.x * x + before.y * y));
      }
    }
  }

  /// The four corners of each panel of a sheet, reached over the joints of a tree whose first facet
  /// lies flat: (x, y, z / tau), panel widths. Each panel has an entry in `facets` and `corners`.
  std::vector<std::array<GradedVector<T>, 4>> place_panels(
      const std::vector<FoldedShape::Branch>& tree, const std::vector<int>& facets,
      const std::vector<std::array<int, 4>>& corners) const {
    struct Frame {
      GradedQuaternion<T> turn = identity();
      T inverse{1.0};
      int vertex = -1;       // a point of the facet, flat ...
      GradedVector<T> at{};  // ... and folded
    };
    std::map<int, Frame> frames;
    const int root = tree.empty() ? facets.front() : tree.front().parent;
    frames[root].vertex = corners.front()[0];
    frames[root].at = point(corners.front()[0]);
    for (const FoldedShape::Branch& branch : tree) {
      const Frame& parent = frames.at(branch.parent);
      const Joint joint = passed(branch.joint);
      frames[branch.facet] = {then(parent.turn, branch.joint, joint),
                              parent.inverse * joint.inverse, branch.joint.vertex,
                              placed(parent, branch.joint.vertex)};
    }
    std::vector<std::array<GradedVector<T>, 4>> placed_corners;
    for (std::size_t p = 0; p < facets.size(); ++p) {
      const Frame& frame = frames.at(facets[p]);
      auto& four = placed_corners.emplace_back();
      for (int k = 0; k < 4; ++k) four[k] = placed(frame, corners[p][k]);
    }
    return placed_corners;
  }

 private:
  friend class GradedSpring<GradedClosure>;

  GradedVector<T> way(int from, int to) const {
    return {geometry_.x[to] - geometry_.x[from], geometry_.y[to] - geometry_.y[from], T(0.0)};
  }

  // Joints at one corner of a hole: the products before each, and the displacement of the next side
  // by all.
  struct Corner {
    std::vector<GradedQuaternion<T>> before;
    std::vector<T> inverse;
    GradedVector<T> displaced;
  };
  static int middle_corner(const Diagonal& diagonal) { return (diagonal.from_corner + 1) % 4; }
  static std::size_t end_of_corner(const Loop& loop, int corner) {
    return corner == 3 ? loop.passages.size() : static_cast<std::size_t>(loop.arrival[corner + 1]);
  }
  Corner go_round_corner(const Loop& loop, int at) const {
    Corner corner;
    GradedQuaternion<T> q = identity();
    T inverse(1.0);
    for (std::size_t j = loop.arrival[at]; j < end_of_corner(loop, at); ++j) {
      corner.before.push_back(q);
      corner.inverse.push_back(inverse);
      const Joint joint = passed(loop.passages[j]);
      q = corner.before.size() == 1 ? joint.q : then(q, loop.passages[j], joint);
      inverse = inverse * joint.inverse;
    }
    corner.displaced = displacement_of_plane(sigma_, q, inverse, side(loop, at));
    return corner;
  }
  // Results of a walk round a loop.
  struct Walk {
    std::vector<GradedQuaternion<T>> before;   // one per passage, and one after the last
    std::vector<T> inverse;                    // 1 / |before|^2
    std::array<GradedVector<T>, 3> displaced;  // sides 0 to 2; the last one is as on the flat sheet
  };

  static GradedQuaternion<T> identity() { return {T(1.0), T(0.0), T(0.0), T(0.0)}; }
  static GradedVector<T> plus(const GradedVector<T>& a, const GradedVector<T>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  GradedVector<T> point(int vertex) const {
    return {geometry_.x[vertex], geometry_.y[vertex], T(0.0)};
  }
  template <class Frame>
  GradedVector<T> placed(const Frame& frame, int vertex) const {
    const GradedVector<T> flat = way(frame.vertex, vertex);
    const GradedVector<T> shift = displacement_of_plane(sigma_, frame.turn, frame.inverse, flat);
    return plus(frame.at, moved(sigma_, flat, shift));
  }
  GradedVector<T> axis(const Passage& passage) const {
    const int edge = mechanism_.creases[passage.joint].edge;
    return {geometry_.axis_x[edge], geometry_.axis_y[edge], T(0.0)};
  }
  GradedVector<T> side(const Loop& loop, int k) const {
    return way(loop.corners[k], loop.corners[(k + 1) % 4]);
  }

  Joint passed(const Passage& passage) const {
    if (passage.ball) {
      const Joint& joint = balls_[passage.joint];
      return passage.sense > 0 ? joint : Joint{joint.q.conjugate(), joint.inverse};
    }
    const Joint& joint = creases_[passage.joint];
    const T s = passage.sense > 0 ? -joint.q.x : joint.q.x;
    const GradedVector<T> u = axis(passage);
    return {{joint.q.w, s * u.x, s * u.y, T(0.0)}, joint.inverse};
  }

  GradedQuaternion<T> then(const GradedQuaternion<T>& before, const Passage& passage,
                           const Joint& joint) const {
    return passage.ball ? product(sigma_, before, joint.q)
                        : product_in_plane(sigma_, before, joint.q);
  }

  Walk walk_round(const Loop& loop) const {
    Walk walk;
    walk.before.push_back(identity());
    walk.inverse.push_back(T(1.0));
    for (const Passage& passage : loop.passages) {
      const Joint joint = passed(passage);
      const bool first = walk.before.size() == 1;
      walk.before.push_back(first ? joint.q : then(walk.before.back(), passage, joint));
      walk.inverse.push_back(first ? joint.inverse : walk.inverse.back() * joint.inverse);
    }
    for (int k = 0; loop.rows == 6 && k < 3; ++k) {
      const std::size_t facet = end_of_corner(loop, k);
      walk.displaced[k] =
          displacement_of_plane(sigma_, walk.before[facet], walk.inverse[facet], side(loop, k));
    }
    return walk;
  }

  // Rate q' q^-1 of a joint while one of its unknowns grows at rate 1: the vector part is half the
  // angular velocity of all that comes after, the scalar part the growth of the length.
  GradedQuaternion<T> turning(const Passage& passage, int unknown) const {
    const Joint joint = passed(passage);
    if (passage.ball) {
      const GradedQuaternion<double>& r = chart_.balls[passage.joint].rate[unknown];
      GradedQuaternion<T> rate{T(r.w), T(r.x), T(r.y), T(r.z)};
      if (passage.sense < 0) rate = rate.conjugate();
      return scaled(joint.inverse, product(sigma_, rate, joint.q.conjugate()));
    }
    const Chart::Crease& at = chart_.creases[passage.joint];
    const Joint& value = creases_[passage.joint];
    const T turn = at.s_rate * value.q.w - at.c_rate * value.q.x;
    const T growth = at.c_rate * value.q.w + sigma_(at.s_rate * value.q.x);
    const T along = passage.sense > 0 ? -turn : turn;
    const GradedVector<T> u = axis(passage);
    return scaled(joint.inverse, {growth, along * u.x, along * u.y, T(0.0)});
  }
  static GradedQuaternion<T> scaled(const T& k, const GradedQuaternion<T>& q) {
    return {k * q.w, k * q.x, k * q.y, k * q.z};
  }

  // Half the angular velocity, in the frame of the walk's start.
  GradedVector<T> turning_from(const Passage& passage, int unknown,
                               const GradedQuaternion<T>& before, const T& inverse) const {
    const GradedVector<T> w = turning(passage, unknown).vector();
    return moved(sigma_, w, displacement(sigma_, before, inverse, w));
  }

  void write_columns(const Loop& loop, const Walk& walk, std::size_t j,
                     std::vector<T>& values) const {
    const Passage& passage = loop.passages[j];
    if (!passage.ball && passage.joint == mechanism_.pilot) return;
    const GradedQuaternion<T>& whole = walk.before.back();
    for (int unknown = 0; unknown < (passage.ball ? 3 : 1); ++unknown) {
      const GradedQuaternion<T> turn = turning(passage, unknown);
      GradedVector<T> w = turn.vector();
      if (j > 0) {
        w = moved(sigma_, w, displacement(sigma_, walk.before[j], walk.inverse[j], w));
      }
      const GradedQuaternion<T> rate = product(sigma_, {turn.w, w.x, w.y, w.z}, whole);
      values.push_back(rate.x);
      values.push_back(rate.y);
      values.push_back(rate.z);
      if (loop.rows == 3) continue;
      const GradedVector<T> sides = sum_after(loop, j, [&](int k) { return side(loop, k); });
      const GradedVector<T> displaced =
          sum_after(loop, j, [&](int k) { return walk.displaced[k]; });
      const T x = sides.x + sigma_(displaced.x), y = sides.y + sigma_(displaced.y);
      values.push_back(2.0 * (w.y * displaced.z - w.z * y));
      values.push_back(2.0 * (w.z * x - w.x * displaced.z));
      values.push_back(2.0 * (w.x * y - w.y * x));
    }
  }

  // The sum over those of the sides 0 to 2 whose facets come after a passage.
  template <class Use>
  GradedVector<T> sum_after(const Loop& loop, std::size_t passage, const Use& of_side) const {
    GradedVector<T> sum{T(0.0), T(0.0), T(0.0)};
    for (int k = 0; k < 3; ++k) {
      if (end_of_corner(loop, k) > passage) sum = plus(sum, of_side(k));
    }
    return sum;
  }

  const Mechanism& mechanism_;
  const SheetGeometry<T>& geometry_;
  const Chart& chart_;
  const Sigma sigma_;
  std::vector<Joint> creases_, balls_;
};

}  // namespace misalign::solver
