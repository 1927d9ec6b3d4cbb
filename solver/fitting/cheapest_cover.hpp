// Finds the cheapest options that cover a demand: branch and bound over linear programs.
//
// A clique is a set of options of which at most one is taken. The relaxation min price . y, gains y
// >= demand, sum y <= 1 in each clique, y >= 0 is solved by its dual, whose origin is feasible
// because no price is negative.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace misalign::solver {

struct CoverOption {
  double price;           ///< not negative
  Eigen::VectorXd gains;  ///< per row, of any sign
};

struct CoverProblem {
  std::vector<CoverOption> options;
  std::vector<std::vector<int>> cliques;  ///< options of which at most one is taken
  Eigen::VectorXd demand;                 ///< per row
};

struct CoverSearch {
  int most_nodes = 20000;
  /// Covers of this price or more do not count.
  double price_below = std::numeric_limits<double>::infinity();
};

struct Cover {
  enum class StopReason { optimal, too_long, none };

  StopReason end = StopReason::none;  ///< none: no options cover the demand
  std::vector<int> chosen;            ///< ascending options
  double price = 0;
  double bound = 0;  ///< no cover costs less
  int nodes = 0, pivots = 0;
};

/// A row is covered to 1e-8 of its largest gain or demand.
Cover cheapest_cover(const CoverProblem& problem, const CoverSearch& search = {});

}  // namespace misalign::solver
