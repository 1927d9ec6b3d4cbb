// A folding path: the stations at which the pilot is held, what was found there, and how it ended.
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
  bool visit;  ///< false for a solver step in between that nobody asked to see
};

/// What all draws of a campaign share: the stations and the state that starts the first of them.
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
  int forward_sign = 0;  ///< of the determinant on this half of the curve; 0: not known
};

/// Angles of the pilot that are no farther apart are one station: far above the rounding of 180
/// degrees, far below what anyone asks for.
inline constexpr double kSameAngle_deg = 1e-9;

struct PathPlanOptions {
  double sample_deg = 1;
  double end_deg = 180;  ///< visited, whether it is a sample or not
  double look_deg = 0;   ///< visit multiples of this as well; 0: only the samples
  double longest_step_deg = 1;
  std::vector<double> look_at_deg{};  ///< visit these as well, as far as end_deg
};

PathPlan plan_path(const Mechanism& mechanism, const BaseFolding& folding,
                   const FlatVertices& base_vertices_mm, const PathPlanOptions& options);

/// What was found at a station.
struct PathPoint {
  explicit PathPoint(const Mechanism& mechanism);
  ~PathPoint();

  FoldState<double> state;
  std::vector<double> lengths, slopes;  ///< of the diagonals: panel widths, per radian of pilot
  double pilot_rate = 1;                ///< the pilot's entry of the unit tangent
  /// Of every unknown per radian of pilot, in column order: where they are wanted; else empty.
  std::vector<double> rates;
  /// How far the tangent is from one, per radian of pilot: what slopes are worth.
  double misfit = 0;
};

enum class PathEnd {
  end_reached,  ///< the last station was solved
  stopped,      ///< the visitor had seen enough
  fold_limit,   ///< the pilot reaches a limit point before the next station
  start_lost,   ///< Newton found no first solution near the base folding: a numerical failure
  stalled       ///< neither with the pilot held nor along the arc is there a way on: a numerical
                ///< failure
};

struct PathResult {
  PathEnd end;
  double fold_limit_deg;  ///< the limit point; otherwise how far the path was solved
  int newton_solves, newton_iterations, arc_steps;
  int forward_sign = 0;  ///< as of PathStart; 0: not known yet

  /// Whether the solver failed where the path may go on.
  bool lost() const { return end == PathEnd::start_lost || end == PathEnd::stalled; }
};

/// Of many paths.
struct Effort {
  std::uint64_t solves = 0, iterations = 0;

  void add(const PathResult& path);
  void add(const Effort& other);
};

}  // namespace misalign::solver
