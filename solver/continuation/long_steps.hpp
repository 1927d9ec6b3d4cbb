// Steps from node to node of a path function: as long as the extrapolation through the last nodes
// and the polynomials between them allow. They give up early: what they cannot follow with
// certainty is for CloseSteps.
#pragma once

#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/continuation/path_function.hpp"
#include "solver/continuation/step.hpp"

namespace misalign::solver {

class LongSteps {
 public:
  struct Options {
    /// The largest sum of a node's corrections (rad): what lies farther from the extrapolation may
    /// belong to another branch.
    double longest_correction_rad = 0.1;
    /// The wanted error of the extrapolation (rad): the next step's length follows.
    double wanted_correction_rad = 3e-3;
    /// The same of what a segment's polynomials would lose without their last node (panel widths,
    /// rad); beyond the last number the segment is not believed.
    double wanted_roughness = 3e-8, most_roughness = 3e-7;
    /// Paths are followed closely beyond this angle: next to 180 degrees branches are near each
    /// other.
    double last_deg = 178.5;
    double longest_step_rad = 0.4, shortest_step_rad = 1e-3;
    /// The least cosine between the tangents of neighbouring nodes.
    double least_tangent_cosine = 0.7;
    int max_corrections = 5;
    /// The wanted error of a limit point (rad of pilot): 6e-8 degrees.
    double limit_tolerance_rad = 1e-9;
  };

  /// `mechanism` must outlive this object.
  LongSteps(const Mechanism& mechanism, const Options& options);
  ~LongSteps();
  LongSteps(const LongSteps&);

  /// As of CloseSteps; stations ascend.
  void begin(const PathStart& start);
  PathStep after(const NewtonReport& report);
  PathStep proceed();
  PathStep stop(PathEnd how) { return end(how); }

  /// Where the node that was found is to be written.
  PathFunction::Node& vacant() { return function_.vacant(); }
  /// Takes the node that was written; false: its segment is not believed, take_back() says what
  /// next.
  bool take();
  PathStep take_back();
  /// Whether the node ends a segment: one on the way to a limit point does not.
  bool ends_segment() const;
  const PathFunction& function() const { return function_; }
  /// Weights of the last nodes for the state at a point of the newest segment.
  PathStep state_at(double x) const;

  bool under_way() const { return plan_ != nullptr; }
  bool is_free() const { return is_free_; }
  int newest() const { return function_.count() - 1; }
  /// The path up to here: its end if it has reached one.
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
