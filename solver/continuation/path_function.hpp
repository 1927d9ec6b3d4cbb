// A folding path as a function: between two of its solved points (nodes) everything is a polynomial
// through the last nodes' values and rates of change, with a bound of its error.
//
// The variable is the fold angle of one crease: of the pilot as long as that turns about as fast as
// any other, then of a faster one, along which the path goes on smoothly where the pilot turns back
// (local parameterisation; Rheinboldt & Burkardt, ACM TOMS 9, 1983). Flat is a node too, where
// lengths are known and do not change; of springs off the mid-plane only lengths are known there.
#pragma once

#include <vector>

#include "solver/continuation/hermite.hpp"
#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// What an observer says of a new segment of a path.
enum class ObserverResult {
  go_on,
  enough,  ///< nothing more is wanted of the path
  lost,    ///< it cannot be judged by a function
  unsure   ///< the errors are too large for what it wants to know: a shorter segment is wanted
};

/// Terms do not always fall: the largest error that was seen was 36 times the largest last terms of
/// all diagonals, in 5 million angles of 110,000 sheets; in all but one family 11 times.
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
    std::vector<double> lengths, slopes;  ///< of the diagonals, panel widths
    double misfit = 0;                    ///< how far the tangent is from one
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

  /// Nodes that the polynomials go through, at most.
  static constexpr int kNodes = 5;

  /// `mechanism` must outlive this object, which owns its memory from the start.
  explicit PathFunction(const Mechanism& mechanism);
  ~PathFunction();
  PathFunction(const PathFunction&);
  PathFunction(PathFunction&&);

  /// A sheet whose diagonals have these lengths flat.
  void begin(const double* flat_lengths);
  /// Where the next node is to be written, before add().
  Node& vacant() {
    Node& next = nodes_[place(-1)];
    next.angle_of = -1;
    return next;
  }
  /// The next node, at the end of a new segment.
  void add();
  /// The next node near the turning point of the newest segment: instead of another one that is
  /// there.
  void add_at_turn();
  /// Takes the last node back.
  void drop();

  int count() const { return count_; }
  /// The k-th node, the newest first; as many as kNodes are kept.
  const Node& node(int k) const { return nodes_[place(k)]; }
  int kept() const;

  /// The crease whose fold angle is the variable, and its value at the k-th node, increasing (rad).
  int variable() const { return variable_; }
  double at(int k) const { return at_[k]; }
  /// Of the k-th node's tangent: its entry for the variable.
  double variable_rate(int k) const { return sign_ * node(k).crease_rates[variable_]; }
  /// Whether flat counts as a node, at 0.
  bool from_flat() const { return count_ < kNodes && variable_ == pilot_; }
  /// Whether lengths are even in the pilot's angle, so that their rates are 0 there.
  bool is_even() const { return mechanism_.springs.in_mid_plane(); }
  /// The newest segment: from node to node, or to the pilot's turning point.
  double from() const { return from_; }
  double to() const { return at_[inside_]; }
  bool has_node_at_turn() const { return inside_ > 0; }
  bool turns() const { return node(inside_).crease_rates[pilot_] <= 0; }
  double end() const { return end_; }
  /// By how much the segment's lengths and pilot angle would change without its last node, at the
  /// middle of it (panel widths, rad).
  double roughness() const;
  /// The pilot's fold angle (rad), its rate, and a bound of its error.
  double pilot(double x) const;
  double pilot_slope(double x) const;
  double pilot_error(double x) const;
  /// What the polynomials' own terms do not say of a length's error: that of a node, and of its
  /// tangent (panel widths).
  double node_error() const;
  /// How far the pilot still goes on from the node at the turn.
  double pilot_rise() const;
  /// Where on the way from the oldest node kept the pilot has this angle; it must grow there.
  double locate(double pilot_rad) const;
  double pilot_at_oldest() const { return pilot(from_flat() ? 0 : at_[kept() - 1]); }
  /// Whether the pilot goes on all over the segment for certain, though not at its end if it turns.
  bool pilot_goes_on() const;

  /// The diagonals' lengths at a point of the segment (panel widths), and bounds of their errors.
  void find_lengths(double x, std::vector<double>& lengths, std::vector<double>& errors) const;
  /// The same with their slopes.
  void look(double x, Estimate& estimate) const;
  /// The same of a single one: its rate per radian of pilot.
  double slope(int diagonal, double x) const;

  /// Whether no crease comes near zero or 180 degrees on the segment.
  bool creases_are_clear() const;
  /// The creases at a point of the segment, and a bound of the error of any of these numbers.
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
  int count_ = 0, inside_ = 0;  // nodes; of them at the newest segment's turn, 0 or 1
  std::vector<Node> nodes_;     // a ring
  std::vector<double> flat_, values_, rates_;
  mutable std::vector<double> scratch_;
  int variable_ = 0;
  double sign_ = 1;
  double at_[kNodes + 1] = {};
  double from_ = 0, end_ = 0;
  mutable double located_x_ = 0, located_rad_ = 0, located_slope_ = 1;  // by the last locate()
  HermiteTable table_;  // of the diagonals, and of the pilot's angle
};

}  // namespace misalign::solver
