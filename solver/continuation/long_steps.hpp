// Chooses steps from node to node of a path function, as long as the extrapolation through the last
// nodes and the polynomials between them allow. It gives up early: paths that it cannot follow with
// certainty are left to CloseSteps.
#pragma once

#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/continuation/path_function.hpp"
#include "solver/continuation/step.hpp"

namespace misalign::solver {

class LongSteps {
 public:
  struct Options {
    /// The largest sum of a node's corrections (rad): a state farther from the extrapolation may
    /// belong to another branch.
    double longest_correction_rad = 0.1;
    /// Target error of the extrapolation (rad), from which the next step's length follows.
    double wanted_correction_rad = 3e-3;
    /// Target and largest roughness of a segment: the change of its polynomials without their last
    /// node (panel widths, rad). Beyond the largest the segment is rejected.
    double wanted_roughness = 3e-8, most_roughness = 3e-7;
    /// Paths are followed closely beyond this angle: next to 180 degrees branches are near each
    /// other.
    double last_deg = 178.5;
    double longest_step_rad = 0.4, shortest_step_rad = 1e-3;
    /// The least cosine between the tangents of neighbouring nodes.
    double least_tangent_cosine = 0.7;
    int max_corrections = 5;
    /// Target error of a limit point (rad of pilot): 6e-8 degrees.
    double limit_tolerance_rad = 1e-9;
  };

  /// `mechanism` must outlive this object.
  LongSteps(const Mechanism& mechanism, const Options& options);
  ~LongSteps();
  LongSteps(const LongSteps&);

  /// Like those of CloseSteps; stations ascend.
  void begin(const PathStart& start);
  PathStep after(const NewtonReport& report);
  PathStep proceed();
  PathStep stop(PathEnd how) { return end(how); }

  /// Place for the node that was solved.
  PathFunction::Node& vacant() { return function_.vacant(); }
  /// Takes the node in vacant(); returns false if its segment is rejected, and take_back() is next.
  bool take();
  PathStep take_back();
  /// Returns whether the node ends a segment: one on the way to a limit point does not.
  bool ends_segment() const;
  const PathFunction& function() const { return function_; }
  /// Weights of the last nodes for the state at a point of the newest segment.
  PathStep state_at(double x) const;

  bool under_way() const { return plan_ != nullptr; }
  bool is_free() const { return is_free_; }
  int newest() const { return function_.count() - 1; }
  /// The path so far, with its end if it has reached one.
  const PathResult& result() const { return result_; }

 private:
  void choose_step();
  PathStep depart();
  PathStep retry();
  PathStep end(PathEnd how);

  const Mechanism& mechanism_;
  const int pilot_;
  const Options options_;
  std::vector<double> flat_;
  const PathPlan* plan_ = nullptr;
  PathFunction function_;
  PathResult result_{};
  Correction correction_;
  bool is_free_ = false, to_limit_ = false;
  int limit_nodes_ = 0;
  double step_ = 0, start_rad_ = 0;
};

}  // namespace misalign::solver
