// Finds the springs that overcome the most friction at every angle of a way, as a linear program.
//
// The slope dE/dx = sum k (L - L0) dL/dx, with rates k and free lengths L0, is linear in k
// and in k L0. A spring whose free length lies between two limits acts as two springs with the
// limits for free lengths, whose rates sum to its rate: all unknowns are rates, and not negative.
#pragma once

#include <vector>

#include "solver/sheet/folding_way.hpp"

namespace misalign::solver {

/// A place of the way at which springs have to drive. Rates are by its coordinate x.
struct DrivenPlace {
  double x, pilot_deg;
  Eigen::VectorXd length_mm, slope_mm;  ///< per diagonal
  double turning_mm;                    ///< sum of each crease's length times its |rate|
  bool is_row = false;                  ///< true if it is a row of the programs
};

/// Limits of one spring; both rates are 0 where there is none.
struct SpringRange {
  double least_n_per_mm, most_n_per_mm;
  double least_free_mm, most_free_mm;
};

/// Diagonals with a largest number of springs, relaxed: the sum of rate / largest rate.
struct SpringGroup {
  std::vector<int> diagonals;
  double most;
};

/// A solved program: springs, and the friction of creases that they overcome everywhere.
struct ProgrammedSprings {
  Eigen::VectorXd rates_n_per_mm, free_mm;
  double static_n_mm_per_mm = 0;  ///< the least of (dE/dx) / turning over the places
  double weakest_deg = 0;         ///< pilot angle of that least
  double bound_n_mm_per_mm = 0;   ///< the program's optimum
  /// Places that limit the optimum, and their weights, which sum to 1: no springs of these limits
  /// overcome more than the weighted mean over these places.
  struct Weight {
    double pilot_deg, weight;
  };
  std::vector<Weight> weights;
};

/// The linear programs of one way. Their rows are those places that limited one of them.
class SpringProgram {
 public:
  /// Places lie at least eight to a station of the way, between two pilot angles, 0 < to < from.
  /// `way` must outlive this object.
  SpringProgram(const FoldingWay& way, double from_deg, double to_deg);

  /// Maximises the friction. Where it is least between places, a place is added.
  ProgrammedSprings solve(const std::vector<SpringRange>& springs,
                          const std::vector<SpringGroup>& groups,
                          const Eigen::VectorXd& largest_n_per_mm);

  const std::vector<DrivenPlace>& places() const { return places_; }
  int programs() const { return programs_; }
  int pivots() const { return pivots_; }

  /// Friction that springs overcome at a place, N mm per mm.
  static double overcome(const DrivenPlace& place, const Eigen::VectorXd& rates_n_per_mm,
                         const Eigen::VectorXd& free_mm);

 private:
  DrivenPlace place_at(double x) const;
  bool add_rows(const ProgrammedSprings& springs, double below);

  const FoldingWay& way_;
  Eigen::VectorXd crease_mm_;
  std::vector<DrivenPlace> places_;  // ascending
  int programs_ = 0, pivots_ = 0;
};

}  // namespace misalign::solver
