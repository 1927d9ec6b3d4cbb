// Sheets and states over any scalar: single, double, extended.
#pragma once

#include <vector>

#include "solver/kinematics/fold_state.hpp"

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

}  // namespace misalign::bench
