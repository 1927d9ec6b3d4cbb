// The matrix of a mechanism while an order of elimination is looked for, at several states at once:
// a pivot must be good at all of them.
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

  /// The cheapest pivot among `columns` whose share of its column's largest entry is at least
  /// `threshold` at every state; of equals one that is markedly larger. No row if there is none.
  Place choose(const std::vector<int>& columns, double threshold);

  /// Removes the pivot's row and column; what it adds to the other rows stays.
  void eliminate(const Place& pivot);

 private:
  // The nonzeros of a row, in column order; columns apart, since they are what is searched.
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
  std::vector<Candidate> candidates_;      // per column, for the threshold asked for last
  double threshold_ = 0;
  Row merged_;                                 // workspace
  std::vector<const PivotValues*> in_column_;  // workspace
};

}  // namespace misalign::solver
