#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {

std::vector<JacobianEntry> jacobian_entries(const Mechanism& mechanism) {
  std::vector<JacobianEntry> entries;
  for (const Loop& loop : mechanism.loops) {
    for (const Passage& passage : loop.passages) {
      const int first = mechanism.first_column(passage);
      for (int k = 0; k < (passage.ball ? 3 : 1); ++k) {
        for (int row = 0; row < loop.rows; ++row) {
          entries.push_back({loop.first_row + row, first + k});
        }
      }
    }
  }
  return entries;
}

}  // namespace misalign::solver
