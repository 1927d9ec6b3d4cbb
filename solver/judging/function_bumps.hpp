// Finds bumps of a path that is a function (BumpRule::exact): whether a diagonal goes back between
// two samples, with lower and upper bounds of the retreat from its polynomials and the error bound
// of their rates.
//
// Near flat lengths are even in the pilot's angle, so that polynomials in its square show in which
// direction a diagonal starts. Springs off the mid-plane have no such symmetry, hence no exact
// bumps.
#pragma once

#include <optional>
#include <vector>

#include "solver/continuation/path_function.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

class FunctionBumps {
 public:
  /// Certain direction of the diagonals between two samples.
  enum class Heading {
    forward,  ///< every diagonal goes forward
    back,     ///< the diagonal where() goes back
    unsure
  };

  /// `mechanism` must outlive this object.
  explicit FunctionBumps(const Mechanism& mechanism);
  ~FunctionBumps();
  FunctionBumps(const FunctionBumps&);

  void begin(const std::vector<double>& flat_lengths);
  /// Returns whether the function is defined on its newest segment: one node is not enough.
  static bool can_look(const PathFunction& function) { return function.count() > 1; }
  /// Begins a new segment, or a shortened one.
  void begin_segment(const PathFunction& function);
  /// Finds the rates by the function's variable at a point of the segment; returns their error
  /// bound.
  double look(double x, std::vector<double>& rates) const;
  /// Advances to the next sample, at point `x` of the segment; `judge` has the directions of
  /// diagonals. The result is not `unsure` if retreats are known within `least_doubt` (panel
  /// widths).
  Heading look_at_sample(double x, const Judge& judge, const PathFunction& function,
                         double least_doubt = 0);
  /// Accepts that sample: the next subsegment begins.
  void take(double pilot_rad);
  /// Advances to the segment's end. `unsure`: the segment is too long to bound the retreats.
  Heading look_at_end(const Judge& judge, const PathFunction& function, double least_doubt = 0);
  /// The diagonal with the largest retreat.
  int where() const { return where_; }
  /// Its rate at point `x` of the segment by the function's variable, if its sign is certain.
  std::optional<double> rate_there(double x);

 private:
  struct Retreats {
    Retreat at_least, at_most;
    int direction = 0;  // direction assumed; 0: it has not moved
  };
  struct Subsegment {
    double from, to;  // values of the table's variable
    double largest_error;
  };

  void go_to(double x, bool is_sample, const Judge& judge, const PathFunction& function);
  int direction(int diagonal, bool is_sample, const Judge& judge,
                const PathFunction& function) const;
  void go(const Subsegment& subsegment, const double* rate, int halvings, Retreats& retreats) const;
  Subsegment subsegment(double from, double to) const;
  Heading heading(double least_doubt);
  Heading settle();
  double variable(double x) const { return in_squares_ ? x * x : x; }

  const Mechanism& mechanism_;
  std::vector<double> flat_, values_, rates_;
  HermiteTable table_;
  bool in_squares_ = false;
  std::vector<int> one_way_;           // per diagonal: direction on the whole segment, or 0
  double reached_rad_ = 0;             // pilot angle up to which kept_ holds
  double room_ = 0, kept_room_ = 0;    // for errors other than those of rates
  std::vector<Retreats> kept_, ways_;  // since the last sample, per diagonal
  bool direction_changed_ = false;
  int where_ = -1;
};

}  // namespace misalign::solver
