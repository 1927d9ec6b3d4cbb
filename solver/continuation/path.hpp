// Describes a folding path: the stations at which the pilot is held, the results there, and its
// end.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// An angle at which the pilot is held.
struct Station {
  double pilot_deg;
  HalfAngle<double> pilot;
  int sample;  ///< k when this is the k-th multiple of sample_deg, otherwise 0
  bool visit;  ///< false for a solver step that no observer sees
};

/// Stations and starting state that all draws of a campaign share.
struct PathPlan {
  std::vector<Station> stations;
  FoldState<double> start;
};

/// One path to follow: the sheet, and a state near the plan's station number `first_station`.
struct PathStart {
  const SheetGeometry<double>* geometry;
  const FoldState<double>* state;
  const PathPlan* plan;
  std::size_t first_station = 0;
  int forward_sign = 0;  ///< the determinant's sign on this half of the curve; 0: unknown
};

/// Pilot angles within this are one station: far above the rounding of 180 degrees, far below any
/// sample distance.
inline constexpr double kSameAngle_deg = 1e-9;

struct PathPlanOptions {
  double sample_deg = 1;
  double end_deg = 180;  ///< visited, whether it is a sample or not
  double look_deg = 0;   ///< its multiples are visited too; 0: only the samples
  double longest_step_deg = 1;
  std::vector<double> look_at_deg{};  ///< further angles to visit, up to end_deg
};

PathPlan plan_path(const Mechanism& mechanism, const BaseFolding& folding,
                   const FlatVertices& base_vertices_mm, const PathPlanOptions& options);

/// Results at a station.
struct PathPoint {
  explicit PathPoint(const Mechanism& mechanism);
  ~PathPoint();

  FoldState<double> state;
  std::vector<double> lengths, slopes;  ///< diagonals: panel widths, and per radian of pilot
  double pilot_rate = 1;                ///< the pilot's entry of the unit tangent
  /// Rates of all unknowns per radian of pilot, in column order; empty unless requested.
  std::vector<double> rates;
  /// Error of the tangent, per radian of pilot: a measure of the slopes' accuracy.
  double misfit = 0;
};

enum class PathEnd {
  end_reached,  ///< the last station was solved
  stopped,      ///< the visitor had seen enough
  fold_limit,   ///< the pilot reaches a limit point before the next station
  start_lost,   ///< no first solution near the base folding: a numerical failure
  stalled       ///< no next point with the pilot held or along the arc: a numerical failure
};

struct PathResult {
  PathEnd end;
  double fold_limit_deg;  ///< the limit point, else the last angle solved
  int newton_solves, newton_iterations, arc_steps;
  int forward_sign = 0;  ///< see PathStart; 0: unknown

  /// True if the solver failed although the path may go on.
  bool lost() const { return end == PathEnd::start_lost || end == PathEnd::stalled; }
};

/// Solver effort of many paths.
struct Effort {
  std::uint64_t solves = 0, iterations = 0;

  void add(const PathResult& path);
  void add(const Effort& other);
};

}  // namespace misalign::solver
