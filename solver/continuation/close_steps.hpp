// Chooses steps from station to station: the next one is reached with the pilot held, or along the
// arc until the pilot reaches it or a limit point.
#pragma once

#include "solver/continuation/path.hpp"
#include "solver/continuation/step.hpp"

namespace misalign::solver {

class CloseSteps {
 public:
  /// Options of steps along the arc (pseudo-arclength continuation: Keller; Allgower & Georg,
  /// Introduction to Numerical Continuation Methods, ch. 6). Lengths are Euclidean, over all
  /// unknowns.
  struct ArcOptions {
    double longest_step_rad = 0.1;
    double shortest_step_rad = 1e-9;  ///< a path that needs shorter ones has stalled
    /// The shortest step while the pilot's rate falls, before a limit point was passed.
    double least_step_by_fall_rad = 0.005;
    /// 15 degrees between the tangents of neighbouring points.
    double least_tangent_cosine = 0.966;
    int most_steps = 5000;  ///< largest number between two stations
    /// The error of the pilot's largest value: 6e-8 degrees; 0.001 is required.
    double limit_tolerance_rad = 1e-9;
    /// If a path stalls or has a limit point within this below a station, the pilot is held there
    /// once more: the station may be singular, as 180 degrees is where another branch crosses. 0:
    /// never.
    double singular_gap_rad = 0;
    /// The try starts from a node at least this far below the station. The tangent's prediction
    /// from there has the square of this as its error, and is kept if it closes all loops: a
    /// correction has an error of rounding divided by the least singular value.
    double try_from_rad = 1e-6;
    /// The largest turn of a crease in that try, sin(half of it). The path's own solution lies at a
    /// distance of about the gap's root: 4e-4 rad for 1e-5 degrees.
    double longest_try_half_sine = 5e-3;
  };

  struct Options {
    double closure_tolerance = Newton::Options{}.closure_tolerance;
    /// Extrapolated stations converge in one or two corrections; more have lost the branch.
    int max_corrections = 10;
    /// The least number of corrections at a station other than the first: its tangent is that of
    /// the state before the last correction.
    int least_corrections = 1;
    /// The least gain of a correction next to a solution beyond 179 degrees (see Correction):
    /// double solutions are left to the arc.
    double least_gain = 8;
    /// The largest turn of a crease from one station to the next, sin(half of it), and of all its
    /// corrections together (rad): a state beyond them is sought along the arc. Steps of 1 degree
    /// move a crease by 1 to 3 degrees, more only within 0.1 of a fold limit; 20 degrees is a jump
    /// to another branch.
    double longest_half_sine = 0.17364817766693033;
    double longest_correction_rad = 2 * kPi;
    double longest_start_share = kLongestStartShare;
    /// The least cosine between the tangents of neighbouring stations: where they differ more, a
    /// limit point may lie between them. As on the arc, 15 degrees.
    double least_tangent_cosine = ArcOptions{}.least_tangent_cosine;
    ArcOptions arc;
  };

  /// Nodes from which states are extrapolated.
  static constexpr int kNodes = 2;

  CloseSteps() : CloseSteps(Options{}) {}
  explicit CloseSteps(const Options& options) : options_(options) {}

  /// Begins a path near the plan's station number `first_station`. Stations ascend, or descend if
  /// the arc is not needed. `forward_sign` is the determinant's sign on this half of the curve, 0
  /// if unknown.
  void begin(const PathStart& start);
  PathStep after(const NewtonReport& report);
  /// Departs from the station reached to the next one.
  PathStep proceed();
  /// Ends the path because the visitor has seen enough.
  PathStep stop() { return end(PathEnd::stopped); }

  /// Returns whether the largest turn of a crease is needed: at a station where every loop closes.
  bool asks_for_turn(double open_by) const {
    return !is_free() && open_by <= options_.closure_tolerance;
  }
  bool under_way() const { return phase_ != Phase::idle; }
  /// Returns whether the corrector may move the pilot.
  bool is_free() const { return phase_ == Phase::arc; }
  const Station& target() const { return plan_->stations[station_]; }
  /// The newest node's number, counted from 0.
  int newest() const { return kept_ - 1; }
  const PathResult& result() const { return result_; }

 private:
  enum class Phase { idle, stepping, arc, landing, ahead, last_try };
  struct Node {
    HalfAngle<double> pilot;
    double at_rad;  // the station's angle
    double rate;    // the unit tangent's entry for the pilot
  };

  Correction::Options correction() const;
  double longest_half_sine() const;
  PathStep converged(const NewtonReport& report);
  PathStep found_on_arc(const NewtonReport& report);
  PathStep arrive(const NewtonReport& report, double tangent_sign);
  void note(const NewtonReport& report, double rate);
  PathStep not_there();
  PathStep begin_arc();
  PathStep go_along();
  double next_along_arc(double tangent_pilot) const;
  PathStep at_limit_point(double rise_rad);
  PathStep no_way_on(PathEnd why);
  PathStep try_station(int from);
  PathStep end(PathEnd end);
  const Node& node(int k) const { return nodes_[k % kStatePlaces]; }
  const Node& last() const { return node(newest()); }
  double gap_rad(int k) const;

  Options options_;
  const PathPlan* plan_ = nullptr;
  std::size_t station_ = 0;
  Phase phase_ = Phase::idle;
  Correction correction_;
  int kept_ = 0;                   // nodes, of stations and on the arc
  int stations_ = 0;               // number of newest nodes for extrapolation
  Node nodes_[kStatePlaces] = {};  // by place
  double ds_ = 0;                  // the next step along the arc
  double bend_ = 0;    // fall of the tangent's pilot entry per unit of length, past a limit point
  int arc_steps_ = 0;  // since the last station
  PathResult result_{};
};

}  // namespace misalign::solver
