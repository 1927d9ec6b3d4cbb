// Bumps of a path that is a function (BumpRule::exact): whether a diagonal goes back between two
// samples, and how far at least and at most, as its polynomials and the bound of their rates'
// errors have it.
//
// Near flat lengths are even in the pilot's angle, so there the polynomials are taken in its
// square: their rates then say which way a diagonal sets out. So of springs off the mid-plane bumps
// are not looked for exactly.
#pragma once

#include <optional>
#include <vector>

#include "solver/continuation/path_function.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

class FunctionBumps {
 public:
  /// What is certain of the way from one sample to the next.
  enum class Heading {
    forward,  ///< every diagonal goes on
    back,     ///< one goes back: where() says which
    unsure
  };

  /// `mechanism` must outlive this object.
  explicit FunctionBumps(const Mechanism& mechanism);
  ~FunctionBumps();
  FunctionBumps(const FunctionBumps&);

  void begin(const std::vector<double>& flat_lengths);
  /// Whether the function says enough of its newest segment: one node does not.
  static bool can_look(const PathFunction& function) { return function.count() > 1; }
  /// A new segment, or one again that was too long.
  void begin_segment(const PathFunction& function);
  /// The rates at a point of it, by the function's variable, and the bound of their errors there.
  double look(double x, std::vector<double>& rates) const;
  /// On to the next sample, at this point of the segment; the judge knows which way diagonals go.
  /// It is not unsure where the ways back are known to within `least_doubt` (panel widths).
  Heading look_at_sample(double x, const Judge& judge, const PathFunction& function,
                         double least_doubt = 0);
  /// That sample counts: the next subsegment begins.
  void take(double pilot_rad);
  /// On to the end of the segment. `unsure`: it is too long to say how far diagonals went back on
  /// it.
  Heading look_at_end(const Judge& judge, const PathFunction& function, double least_doubt = 0);
  /// The diagonal that goes back the most.
  int where() const { return where_; }
  /// Its rate at this point of the segment, by the function's variable, if its sign is certain.
  std::optional<double> rate_there(double x);

 private:
  struct Retreats {
    Retreat at_least, at_most;
    int direction = 0;  // in which it was looked at; 0: it has not moved
  };
  struct Subsegment {
    double from, to;  // of the table's variable
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
  std::vector<int> one_way_;           // of diagonals: the way they go on the whole segment, or 0
  double reached_rad_ = 0;             // the pilot's angle up to which kept_ goes
  double room_ = 0, kept_room_ = 0;    // for errors that are not the rates'
  std::vector<Retreats> kept_, ways_;  // since the last sample; of diagonals
  bool direction_changed_ = false;
  int where_ = -1;
};

}  // namespace misalign::solver
