// Holds the Jacobian while its order of elimination is chosen, at several states at once: a pivot
// must be good at all of them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {

inline constexpr int kPivotStates = 10;

/// A nonzero at every state.
using PivotValues = std::array<double, kPivotStates>;

class ActiveMatrix {
 public:
  ActiveMatrix(const std::vector<JacobianEntry>& entries, const std::vector<PivotValues>& values,
               int equations);
  ~ActiveMatrix();

  struct Place {
    int row = -1, column = -1;
  };

  /// The cheapest pivot in `columns` that is at least `threshold` of its column's largest entry at
  /// every state; of equally cheap pivots a markedly larger one wins. No row if there is none.
  Place choose(const std::vector<int>& columns, double threshold);

  /// Removes the pivot's row and column; other rows keep what it adds to them.
  void eliminate(const Place& pivot);

 private:
  // The nonzeros of a row, in column order. Columns are stored apart, since they are searched.
  struct Row {
    std::vector<int> columns;
    std::vector<PivotValues> values;

    const PivotValues& at(int column) const;
  };

  struct Candidate {
    bool known = false;
    int row = -1;
    std::size_t cost = ~std::size_t{0};
    double share = 0;
    bool before(const Candidate& other) const;
  };

  void subtract(const PivotValues& factors, const Row& pivot_row, int pivot_column, int row);
  Candidate best_in(int column);

  std::vector<Row> rows_;
  std::vector<std::vector<int>> rows_in_;  // per column, in order
  std::vector<Candidate> candidates_;      // per column, for the last threshold
  double threshold_ = 0;
  Row merged_;                                 // workspace
  std::vector<const PivotValues*> in_column_;  // workspace
};

}  // namespace misalign::solver
