// Springs that end at points of their own.
#pragma once

#include <algorithm>

#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

/// `springs`, but that three of each hole's four end on the first, the second and the last panel at
/// their corners, a few mm inside, beside the bisector and `height_mm` off the mid-plane.
inline SpringEnds with_own(const PerforatedSheet& base, SpringEnds springs, double height_mm) {
  for (std::size_t h = 0; h < base.holes.size(); ++h) {
    const int hole = base.holes[h];
    for (std::size_t k = 0; k < 3; ++k) {
      const int vertex = base.sheet.facets[static_cast<std::size_t>(hole)][(h + k) % 4];
      std::vector<int> panels = facets_around(base.sheet, vertex);
      std::erase_if(panels, [&](int f) { return std::ranges::binary_search(base.holes, f); });
      const int panel = k == 2 ? panels.back() : panels[k];
      springs.own.push_back(
          {hole,
           vertex,
           panel,
           {4.0 + static_cast<double>(k), 0.7 - static_cast<double>(k), height_mm}});
    }
  }
  return springs;
}

}  // namespace misalign::solver
