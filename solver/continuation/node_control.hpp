// Step control from node to node of a path function: steps as long as the extrapolation through the
// last nodes and the polynomials between them allow. It gives up early: what it cannot follow with
// certainty is for the close steps of StepControl.
#pragma once

#include <vector>

#include "solver/continuation/path_function.hpp"
#include "solver/continuation/step_control.hpp"

namespace misalign::solver {

/// Of the last nodes that a state is extrapolated from, each with its tangent.
inline constexpr int kStateNodes = 4;
/// Places for them: one more, so that a node can be taken back.
inline constexpr int kStatePlaces = kStateNodes + 1;

struct NodeControlOptions {
  /// Of all corrections of a node together (rad): what lies farther from the extrapolation may
  /// belong to another branch.
  double longest_correction_rad = 0.1;
  /// How far the extrapolation is wanted to be off (rad): the next step's length follows.
  double wanted_correction_rad = 3e-3;
  /// The same of what a segment's polynomials would lose without their last node (panel widths,
  /// rad); beyond the last number the segment is not believed.
  double wanted_roughness = 3e-8, most_roughness = 3e-7;
  /// Beyond it paths are followed closely: next to 180 degrees branches are near each other.
  double last_deg = 178.5;
  double longest_step_rad = 0.4, shortest_step_rad = 1e-3;
  /// Between the tangents of neighbouring nodes.
  double least_tangent_cosine = 0.7;
  int max_corrections = 5;
  /// How well a limit point is wanted (rad of pilot): 6e-8 degrees.
  double limit_tolerance_rad = 1e-9;
};

/// What to do with a lane now.
struct NodeStep {
  bool arrived = false;  ///< at a node: to be filled in and taken
  bool ended = false;    ///< result() says how
  bool depart = false;   ///< to the state that these weights make of the last nodes, by place
  double of_values[kStatePlaces] = {}, of_rates[kStatePlaces] = {}, of_flat = 0;
  bool hold = false;  ///< put the pilot at `pilot` after departing
  HalfAngle<double> pilot{1, 0};
};

/// The step control of all lanes.
class NodeControl {
 public:
  NodeControl(const Mechanism& mechanism, int lanes, const NodeControlOptions& options = {});
  ~NodeControl();

  void begin(const PathStart& start, int lane);
  bool under_way(int lane) const { return paths_[lane].plan != nullptr; }
  bool is_free(int lane) const { return paths_[lane].is_free; }
  /// After an iteration.
  NodeStep after(const NewtonReport& report, int lane);
  /// The node that was found, to be written; `tangent_sign` orients its tangent.
  PathNode& vacant(int lane) { return paths_[lane].function.vacant(); }
  double tangent_sign(int lane) const { return paths_[lane].tangent_sign; }
  /// Takes the node that was written; false: its segment is not believed, take_back() says what
  /// next.
  bool take(int lane);
  NodeStep take_back(int lane);
  /// Whether the node ends a segment: one on the way to a limit point does not.
  bool ends_segment(int lane) const;
  const PathFunction& function(int lane) const { return paths_[lane].function; }
  int forward_sign(int lane) const { return paths_[lane].forward_sign; }
  /// In which of the places of the last nodes' states the newest one's belongs.
  int place(int lane) const { return (paths_[lane].function.count() - 1) % kStatePlaces; }
  /// The path up to here: its end if it has reached one.
  const PathResult& result(int lane) const { return paths_[lane].result; }
  NodeStep proceed(int lane);
  NodeStep stop(PathEnd how, int lane) { return end(paths_[lane], how); }
  /// Weights by place for the state at a point of the newest segment.
  NodeStep state_at(double x, int lane) const;

 private:
  struct Path {
    const PathPlan* plan = nullptr;
    PathFunction function;
    PathResult result{};
    bool is_free = false, to_limit = false;
    int limit_nodes = 0;
    int forward_sign = 0, corrections = 0;
    double tangent_sign = 1, corrected_rad = 0, first_correction_rad = 0, last_open = 0;
    double step = 0;
    double target_deg = 0;
  };

  NodeStep depart(Path& path);
  NodeStep retry(Path& path);
  NodeStep end(Path& path, PathEnd how);
  void choose_step(Path& path);
  NodeStep weights(const Path& path, double x) const;
  static double distance_to_nodes(const PathFunction& function, double x);

  const Mechanism& mechanism_;
  const int pilot_;
  const NodeControlOptions options_;
  std::vector<double> flat_;
  std::vector<Path> paths_;
};

}  // namespace misalign::solver
