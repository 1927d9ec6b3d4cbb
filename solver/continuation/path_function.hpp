// Represents a folding path as a function: between two solved points (nodes) every quantity is a
// polynomial through the last nodes' values and rates of change, with a bound of its error.
//
// The variable is the fold angle of one crease: the pilot's while that turns about as fast as any
// other, then a faster one's, in which the path is smooth where the pilot turns back (local
// parameterisation; Rheinboldt & Burkardt, ACM TOMS 9, 1983). Flat is a node too: lengths are known
// and stationary there; for springs off the mid-plane only lengths are known.
#pragma once

#include <vector>

#include "solver/continuation/hermite.hpp"
#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// An observer's answer to a new segment of a path.
enum class ObserverResult {
  go_on,
  enough,  ///< the rest of the path is not needed
  lost,    ///< the path cannot be judged by a function
  unsure   ///< errors are too large: a shorter segment is requested
};

/// Bound of the error, in largest last terms of all diagonals, which do not always decrease: 36 was
/// the largest at 5 million angles of 110,000 sheets, 11 in all but one family.
inline constexpr double kFunctionSafety = 60;

class PathFunction {
 public:
  /// A solved point. Rates are per unit of arc length: those of the creases are the unit tangent's
  /// entries, in the direction of the path.
  struct Node {
    explicit Node(const Mechanism& mechanism);
    ~Node();
    Node(const Node&);
    Node(Node&&);
    Node& operator=(Node&&);

    std::vector<HalfAngle<double>> creases;
    std::vector<double> crease_rates;
    std::vector<double> lengths, slopes;  ///< per diagonal, panel widths
    double misfit = 0;                    ///< error of the tangent
    int angle_of = -1;                    ///< the crease whose angle is known
    double angle_rad = 0;
  };

  /// An estimate of the diagonals at a point between nodes.
  struct Estimate {
    explicit Estimate(const Mechanism& mechanism);
    ~Estimate();

    std::vector<double> lengths;        ///< panel widths
    std::vector<double> length_errors;  ///< bounds
    std::vector<double> slopes;         ///< panel widths per radian of pilot
  };

  /// Largest number of nodes of a polynomial.
  static constexpr int kNodes = 5;

  /// `mechanism` must outlive this object, which owns its memory from the start.
  explicit PathFunction(const Mechanism& mechanism);
  ~PathFunction();
  PathFunction(const PathFunction&);
  PathFunction(PathFunction&&);

  /// Begins a sheet with these flat lengths of its diagonals.
  void begin(const double* flat_lengths);
  /// Place for the next node, to be filled before add().
  Node& vacant() {
    Node& next = nodes_[place(-1)];
    next.angle_of = -1;
    return next;
  }
  /// Adds the node in vacant() at the end of a new segment.
  void add();
  /// Adds the node in vacant() near the newest segment's turning point, replacing an earlier one
  /// there.
  void add_at_turn();
  /// Removes the last node.
  void drop();

  int count() const { return count_; }
  /// The k-th node, the newest first; at most kNodes are kept.
  const Node& node(int k) const { return nodes_[place(k)]; }
  int kept() const;

  /// The crease whose fold angle is the variable, and its value at the k-th node, increasing (rad).
  int variable() const { return variable_; }
  double at(int k) const { return at_[k]; }
  /// Entry of the k-th node's tangent for the variable.
  double variable_rate(int k) const { return sign_ * node(k).crease_rates[variable_]; }
  /// Returns whether flat counts as a node, at 0.
  bool from_flat() const { return count_ < kNodes && variable_ == pilot_; }
  /// Returns whether lengths are even in the pilot's angle, so that their rates are 0 at flat.
  bool is_even() const { return mechanism_.springs.in_mid_plane(); }
  /// The newest segment: from node to node, or to the pilot's turning point.
  double from() const { return from_; }
  double to() const { return at_[inside_]; }
  bool has_node_at_turn() const { return inside_ > 0; }
  bool turns() const { return node(inside_).crease_rates[pilot_] <= 0; }
  double end() const { return end_; }
  /// Change of the lengths and the pilot angle at the segment's middle without its last node (panel
  /// widths, rad).
  double roughness() const;
  /// The pilot's fold angle (rad), its rate, and a bound of its error.
  double pilot(double x) const;
  double pilot_slope(double x) const;
  double pilot_error(double x) const;
  /// Error of a length that the polynomials' terms do not show: that of a node and of its tangent
  /// (panel widths).
  double node_error() const;
  /// Rise of the pilot's angle from the node at the turn to the turning point, rad.
  double pilot_rise() const;
  /// Finds the point after the oldest kept node at which the pilot has this angle; the pilot must
  /// be increasing.
  double locate(double pilot_rad) const;
  double pilot_at_oldest() const { return pilot(from_flat() ? 0 : at_[kept() - 1]); }
  /// Returns whether the pilot certainly increases on the whole segment, except at its end if it
  /// turns.
  bool pilot_goes_on() const;

  /// The diagonals' lengths at a point of the segment (panel widths), and bounds of their errors.
  void find_lengths(double x, std::vector<double>& lengths, std::vector<double>& errors) const;
  /// Finds lengths, error bounds and slopes.
  void look(double x, Estimate& estimate) const;
  /// Slope of one diagonal per radian of pilot.
  double slope(int diagonal, double x) const;

  /// Returns whether all creases stay clear of zero and 180 degrees on the segment.
  bool creases_are_clear() const;
  /// Finds the creases at a point of the segment; returns a bound of the error of each number.
  double find_creases(double x, std::vector<HalfAngle<double>>& creases) const;

 private:
  int place(int k) const { return (count_ - 1 - k + 4 * (kNodes + 1)) % (kNodes + 1); }
  void choose_variable();
  void find_angles();
  void renew();
  void make_table();
  double turning_point() const;
  double pilot_error(double x, double largest_of_lengths) const;

  const Mechanism& mechanism_;
  const int pilot_, diagonals_;
  int count_ = 0, inside_ = 0;  // nodes; nodes at the newest segment's turn, 0 or 1
  std::vector<Node> nodes_;     // a ring
  std::vector<double> flat_, values_, rates_;
  mutable std::vector<double> scratch_;
  int variable_ = 0;
  double sign_ = 1;
  double at_[kNodes + 1] = {};
  double from_ = 0, end_ = 0;
  mutable double located_x_ = 0, located_rad_ = 0, located_slope_ = 1;  // by the last locate()
  HermiteTable table_;  // diagonals, then the pilot's angle
};

}  // namespace misalign::solver
