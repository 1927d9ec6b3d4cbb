// A spring whose ends p and q are beside the corners of its hole, in a state of a GradedClosure.
//
// The joints between both panels take q to q + u in the frame of p's panel. They keep points v_1
// ... v_n, and turn what lies behind them by Q_1 ... Q_n: with w_i = v_(i+1) - v_i and w_n = q -
// v_n, u = sum (Q_i w_i - w_i).
#pragma once

#include <vector>

#include "solver/certificate/graded.hpp"
#include "solver/certificate/spring_vertex.hpp"

namespace misalign::solver {

template <class Closure>
class GradedSpring {
 public:
  using T = typename Closure::Number;

  /// `closure` must outlive this object, and its geometry have the ends behind its vertices.
  GradedSpring(const Closure& closure, const Diagonal& diagonal) : closure_(closure) {
    const Mechanism& mechanism = closure.mechanism_;
    const int p = spring_vertex(mechanism, diagonal.loop, diagonal.from_corner),
              q = spring_vertex(mechanism, diagonal.loop, diagonal.to_corner);
    each_passage_between_ends(mechanism, diagonal,
                              [&](const Passage& passage) { passages_.push_back(&passage); });
    apart_ = closure.way(p, q);
    GradedQuaternion<T> turn = Closure::identity();
    T inverse(1.0);
    for (std::size_t i = 0; i < passages_.size(); ++i) {
      before_.push_back(turn);
      inverse_.push_back(inverse);
      const typename Closure::Joint joint = closure.passed(*passages_[i]);
      turn = i == 0 ? joint.q : closure.then(turn, *passages_[i], joint);
      inverse = inverse * joint.inverse;
      const int next = i + 1 < passages_.size() ? passages_[i + 1]->vertex : q;
      behind_.push_back(closure.way(passages_[i]->vertex, q));
      displaced_.push_back(displacement_of_plane(closure.sigma_, turn, inverse,
                                                 closure.way(passages_[i]->vertex, next)));
    }
    for (std::size_t i = passages_.size() - 1; i-- > 0;) {
      displaced_[i] = Closure::plus(displaced_[i], displaced_[i + 1]);
    }
  }

  /// Change of its squared length from the flat sheet, divided by sigma.
  T stretch() const {
    const GradedVector<T>& u = displaced_.front();
    return 2.0 * (apart_.x * u.x + apart_.y * u.y) + closure_.sigma_(u.x * u.x + u.y * u.y) +
           u.z * u.z;
  }

  /// Its derivative by each unknown of the joints between: use(column, derivative). A joint that
  /// turns by w moves q by 2 w x (q + u - v), which is seen along q + u - p.
  template <class Use>
  void rates(Use& use) const {
    const GradedVector<T> along = moved(closure_.sigma_, apart_, displaced_.front());
    for (std::size_t i = 0; i < passages_.size(); ++i) {
      const Passage& passage = *passages_[i];
      const GradedVector<T> arm = moved(closure_.sigma_, behind_[i], displaced_[i]);
      for (int unknown = 0; unknown < (passage.ball ? 3 : 1); ++unknown) {
        const GradedVector<T> w = closure_.turning_from(passage, unknown, before_[i], inverse_[i]);
        const T x = w.y * arm.z - w.z * arm.y, y = w.z * arm.x - w.x * arm.z,
                z = w.x * arm.y - w.y * arm.x;
        use(closure_.mechanism_.first_column(passage) + unknown,
            4.0 * (along.x * x + along.y * y + along.z * z));
      }
    }
  }

 private:
  const Closure& closure_;
  std::vector<const Passage*> passages_;
  std::vector<GradedQuaternion<T>> before_;  // products of joints, one before each
  std::vector<T> inverse_;
  std::vector<GradedVector<T>> behind_;     // q - v_i, flat
  std::vector<GradedVector<T>> displaced_;  // sums of Q w - w, from each joint on
  GradedVector<T> apart_;                   // q - p, flat
};

}  // namespace misalign::solver
