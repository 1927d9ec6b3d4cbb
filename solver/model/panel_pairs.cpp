#include "solver/model/panel_pairs.hpp"

#include <algorithm>

namespace misalign::solver {

int corner_of(const std::array<int, 4>& corners, int vertex) {
  return static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
}

std::vector<PanelPair> pairs_of(const Panels& panels) {
  std::vector<PanelPair> pairs;
  const auto count = static_cast<int>(panels.corners.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      PanelPair pair{ContactKind::apart, a, b, -1};
      for (const int vertex : panels.corners[a]) {
        if (corner_of(panels.corners[b], vertex) < 4) pair = {ContactKind::vertex, a, b, vertex};
      }
      for (std::size_t crease = 0; crease < panels.folds.size(); ++crease) {
        const FoldLine& fold = panels.folds[crease];
        if (std::minmax(fold.left, fold.right) == std::minmax(a, b)) {
          pair = {ContactKind::crease, a, b, static_cast<int>(crease)};
        }
      }
      pairs.push_back(pair);
    }
  }
  return pairs;
}

}  // namespace misalign::solver
