// Options of springs that are chosen from a table.
#pragma once

#include <utility>
#include <vector>

#include "solver/fitting/stock_spring.hpp"

namespace misalign::solver {

enum class StockGoal {
  fewest_types,  ///< then the least price
  least_price
};

struct StockOptions {
  std::optional<double> from_deg;   ///< angle of use; none: D, or the end of the path
  double to_deg = 1;                ///< springs overcome the friction down to this angle
  double required_n_mm_per_mm = 0;  ///< friction to overcome; 0: energy falls
  bool pushes = false;              ///< true if compression springs may be taken, too
  LinkLimits links;
  std::vector<int> barred;                      ///< diagonals without springs
  std::vector<std::pair<int, int>> never_both;  ///< diagonals that do not both carry springs
  StockGoal goal = StockGoal::fewest_types;
  int most_nodes = 20000;  ///< effort of branch and bound
};

}  // namespace misalign::solver
