#include "solver/certificate/graded_closure.hpp"

#include <cassert>

namespace misalign::solver {

std::vector<JacobianColumn> columns_of(const Mechanism& mechanism) {
  std::vector<JacobianColumn> columns(mechanism.equations);
  const int pilot = mechanism.creases[mechanism.pilot].column;
  int value = 0;
  for (const Loop& loop : mechanism.loops) {
    for (const Passage& passage : loop.passages) {
      for (int k = 0; k < (passage.ball ? 3 : 1); ++k) {
        const int column = mechanism.first_column(passage) + k;
        if (column == pilot) continue;
        assert(column >= 0 && column < mechanism.equations);
        for (int row = 0; row < loop.rows; ++row) {
          columns[column].rows.push_back(loop.first_row + row);
          columns[column].values.push_back(value++);
        }
      }
    }
  }
  return columns;
}

}  // namespace misalign::solver
