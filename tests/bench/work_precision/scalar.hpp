// Sheets, states and lengths over any scalar: single, double, extended.
#pragma once

#include <array>
#include <vector>

#include "solver/loop_closure.hpp"

namespace misalign::bench {

template <class T, class From>
solver::FoldState<T> state_as(const solver::FoldState<From>& from) {
  solver::FoldState<T> state;
  for (const auto& h : from.creases) state.creases.push_back({T(h.c), T(h.s)});
  for (const auto& q : from.balls) state.balls.push_back({T(q.w), T(q.x), T(q.y), T(q.z)});
  return state;
}

template <class T>
std::vector<T> values_as(const std::vector<double>& from) {
  std::vector<T> values;
  values.reserve(from.size());
  for (const double value : from) values.push_back(static_cast<T>(value));
  return values;
}

template <class T>
solver::SheetGeometry<T> geometry_as(const solver::SheetGeometry<double>& from) {
  return {values_as<T>(from.x), values_as<T>(from.y), values_as<T>(from.axis_x),
          values_as<T>(from.axis_y)};
}

template <class T>
solver::HalfAngle<T> pilot_as(double pilot_deg) {
  const solver::HalfAngle<double> pilot = solver::half_angle_of_deg(pilot_deg);
  return {static_cast<T>(pilot.c), static_cast<T>(pilot.s)};
}

/// solver::folded_lengths over any scalar: panel widths, one per diagonal.
template <class T>
void folded_lengths(const solver::Mechanism& mechanism, const solver::SheetGeometry<T>& geometry,
                    const solver::FoldState<T>& state, T* lengths) {
  using std::sqrt;
  int known_loop = -1;
  std::array<solver::Vec3<T>, 4> corners{};
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    if (diagonal.loop != known_loop) {
      known_loop = diagonal.loop;
      const solver::Loop& loop = mechanism.loops[known_loop];
      solver::Pose<T> pose = solver::Pose<T>::identity();
      int next = 0;
      for (int corner = 0; corner < 4; ++corner) {
        for (; next < loop.arrival[corner]; ++next) {
          const solver::Passage& passage = loop.passages[next];
          pose = pose.then_rotate(solver::passage_rotation(mechanism, geometry, state, passage),
                                  solver::flat_point(geometry, passage.vertex));
        }
        corners[corner] = pose * solver::flat_point(geometry, loop.corners[corner]);
      }
    }
    const solver::Vec3<T> d = corners[diagonal.from_corner] - corners[diagonal.to_corner];
    *lengths++ = sqrt(dot(d, d));
  }
}

}  // namespace misalign::bench
