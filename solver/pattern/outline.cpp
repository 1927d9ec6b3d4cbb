#include "solver/pattern/outline.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {

std::vector<int> kept_facets(const CreasePattern& sheet, const std::vector<int>& holes) {
  assert(std::is_sorted(holes.begin(), holes.end()));
  std::vector<int> kept;
  for (int f = 0; f < sheet.facet_count(); ++f) {
    if (!std::binary_search(holes.begin(), holes.end(), f)) kept.push_back(f);
  }
  return kept;
}

std::vector<std::vector<int>> outlines(const CreasePattern& sheet, const std::vector<int>& holes) {
  std::vector<int> next(sheet.vertex_count(), -1);  // along the perimeter
  int start = -1;
  for (const Edge& edge : sheet.edges) {
    if (!edge.on_perimeter()) continue;
    const auto [from, to] = edge.left >= 0 ? std::pair(edge.a, edge.b) : std::pair(edge.b, edge.a);
    next[from] = to;
    if (start < 0) start = edge.a;
  }
  std::vector<std::vector<int>> walks(1);
  assert(start >= 0);
  int at = start;
  do {
    walks[0].push_back(at);
    at = next[at];
    assert(at >= 0);  // the perimeter is closed
  } while (at != start);
  for (const int f : holes) {
    walks.emplace_back(sheet.facets[f].rbegin(), sheet.facets[f].rend());
  }
  return walks;
}

}  // namespace misalign::solver
