// Predictors: the start of Newton's method from solutions already found.
#pragma once

#include <vector>

#include "solver/kinematics/fold_state.hpp"

namespace misalign::bench {

enum class Predictor { previous, tangent, hermite };

/// A solution and its tangent: change of every unknown per radian of the pilot.
template <class T>
struct PathPoint {
  T pilot_rad;
  solver::FoldState<T> state;
  std::vector<T> tangent;
};

/// One step along the tangent of `from`.
template <class T>
void predict_along_tangent(const solver::Mechanism& mechanism, const PathPoint<T>& from,
                           T pilot_rad, std::vector<T>& step, solver::FoldState<T>& state) {
  for (std::size_t i = 0; i < step.size(); ++i) {
    step[i] = from.tangent[i] * (pilot_rad - from.pilot_rad);
  }
  state = from.state;
  solver::advance(mechanism, step.data(), state);
}

/// The cubic through two solutions and their tangents: on the cosine and sine of every half fold
/// angle and on the four entries of every ball joint's quaternion, over the pilot's fold angle,
/// scaled back to length one. Between the two it interpolates, beyond them it extrapolates.
template <class T>
void predict_by_cubic(const solver::Mechanism& mechanism, const PathPoint<T>& p,
                      const PathPoint<T>& q, T pilot_rad, solver::FoldState<T>& state) {
  using std::sqrt;
  const T h = q.pilot_rad - p.pilot_rad;
  const T u = (pilot_rad - p.pilot_rad) / h, v = u - T(1);
  const T at_p = v * v * (T(1) + T(2) * u), at_q = u * u * (T(1) - T(2) * v);
  const T half_along_p = T(0.5) * h * u * v * v, half_along_q = T(0.5) * h * u * u * v;

  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    const int column = mechanism.creases[i].column;
    const solver::HalfAngle<T>&a = p.state.creases[i], &b = q.state.creases[i];
    const T ka = half_along_p * p.tangent[column], kb = half_along_q * q.tangent[column];
    const T c = at_p * a.c + at_q * b.c - (ka * a.s + kb * b.s);
    const T s = at_p * a.s + at_q * b.s + (ka * a.c + kb * b.c);
    const T scale = T(1) / sqrt(c * c + s * s);
    state.creases[i] = {c * scale, s * scale};
  }
  for (std::size_t i = 0; i < mechanism.balls.size(); ++i) {
    const solver::Quaternion<T>&a = p.state.balls[i], &b = q.state.balls[i];
    const T* wa = p.tangent.data() + mechanism.balls[i].column;
    const T* wb = q.tangent.data() + mechanism.balls[i].column;
    const solver::Quaternion<T> da =
        solver::Quaternion<T>{T(0), half_along_p * wa[0], half_along_p * wa[1],
                              half_along_p * wa[2]} *
        a;
    const solver::Quaternion<T> db =
        solver::Quaternion<T>{T(0), half_along_q * wb[0], half_along_q * wb[1],
                              half_along_q * wb[2]} *
        b;
    state.balls[i] = solver::Quaternion<T>{at_p * a.w + at_q * b.w + da.w + db.w,
                                           at_p * a.x + at_q * b.x + da.x + db.x,
                                           at_p * a.y + at_q * b.y + da.y + db.y,
                                           at_p * a.z + at_q * b.z + da.z + db.z}
                         .normalized();
  }
}

}  // namespace misalign::bench
