// The coordinates of one interval of a path: unknowns of its joints that are 0 in the middle, and s
// from -1 to 1 for the pilot.
#pragma once

#include <vector>

#include "solver/certificate/graded_closure.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::solver {

/// The half angle of an exact angle, by Taylor series; -360 to 360 degrees.
HalfAngle<Ball> half_angle_ball(double angle_deg);

/// The sheet whose vertices are exactly these doubles (mm), in panel widths; behind them the ends
/// of springs that are beside the vertices (spring_vertex).
SheetGeometry<Ball> place_exactly(const Mechanism& mechanism, const FlatVertices& vertices_mm);

/// Converts a sheet from numbers S to T.
template <class T, class S>
SheetGeometry<T> convert(const SheetGeometry<S>& geometry) {
  const auto each = [](const std::vector<S>& from) {
    std::vector<T> to;
    to.reserve(from.size());
    for (const S& value : from) to.push_back(T(value));
    return to;
  };
  return {each(geometry.x), each(geometry.y), each(geometry.axis_x), each(geometry.axis_y)};
}

class IntervalChart {
 public:
  IntervalChart() = default;
  /// `mechanism` must outlive this object.
  IntervalChart(const Mechanism& mechanism, const PathInterval& interval);

  const PathInterval& interval() const { return interval_; }
  const Chart& joints() const { return joints_; }
  bool is_graded() const { return interval_.graded; }
  /// Half width from the middle to s = 1: in sigma if graded, otherwise as the tangent of half the
  /// angle.
  double half_width() const { return half_width_; }
  /// sigma in the middle, where graded.
  double sigma() const { return sigma_; }

  /// Moves the middle by these unknowns, so that they are 0 there again.
  void recentre(const double* x);
  /// The state in the middle. Not exact.
  FoldState<double> middle() const { return state_at(nullptr, 0); }
  /// The state at these unknowns (null: all 0) and s. Not exact.
  FoldState<double> state_at(const double* x, double s) const;

  /// s of a pilot angle of the interval.
  Ball place_of(double pilot_deg) const;
  /// The largest angle of the interval whose s is at most this, to 1e-7 degrees.
  double angle_deg_until(double s) const;

  /// A state at a pilot angle as quaternions of any length; creases have (c, s).
  struct PlainState {
    std::vector<HalfAngle<Ball>> creases;
    std::vector<Quaternion<Ball>> balls;
  };
  PlainState plain(const std::vector<Ball>& x, double pilot_deg) const;
  /// The unknowns of such a state, without the pilot's.
  std::vector<Ball> unknowns(const PlainState& state, double pilot_deg) const;

 private:
  void place_joints();

  const Mechanism* mechanism_ = nullptr;
  PathInterval interval_;
  Chart joints_;
  HalfAngle<double> pilot_{1, 0};
  double sigma_ = 0, half_width_ = 0;
};

}  // namespace misalign::solver
