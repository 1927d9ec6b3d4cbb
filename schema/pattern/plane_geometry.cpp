#include "schema/pattern/plane_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::schema {
namespace {

// Returns whether two different edges, a to b and c to d, share a point that is not a common end.
bool meet(const PlanePoints& points, int a, int b, int c, int d) {
  const auto side = [&](int from, int to, int point) {
    return cross(points[to] - points[from], points[point] - points[from]);
  };
  if (b == c || b == d) std::swap(a, b);
  if (a == d) std::swap(c, d);
  if (a == c) {
    return side(a, b, d) == 0 && (points[b] - points[a]).dot(points[d] - points[a]) > 0;
  }
  return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

}  // namespace

bool is_convex(const PlanePoints& points, std::span<const int> loop) {
  const auto corner = [&](std::size_t k) { return points[loop[k % loop.size()]]; };
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (!(cross(corner(k + 1) - corner(k), corner(k + 2) - corner(k + 1)) > 0)) return false;
  }
  return true;
}

std::vector<std::pair<int, int>> coinciding(const PlanePoints& points, double within,
                                            std::size_t most) {
  std::vector<int> order(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) order[v] = static_cast<int>(v);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(points[a].x(), a) < std::pair(points[b].x(), b);
  });
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = i + 1; k < order.size() && pairs.size() < most; ++k) {
      const Eigen::Vector2d apart = points[order[k]] - points[order[i]];
      if (apart.x() > within) break;
      if (std::abs(apart.y()) <= within) pairs.push_back(std::minmax(order[i], order[k]));
    }
  }
  return pairs;
}

std::vector<std::pair<std::pair<int, int>, std::pair<int, int>>> crossing(const PlanePoints& points,
                                                                          const PlaneEdges& edges,
                                                                          std::size_t most) {
  struct Box {
    int a, b;
    double left, right, low, high;
  };
  std::vector<Box> boxes;
  for (const auto& [key, assignment] : edges) {
    const Eigen::Vector2d &p = points[key.first], &q = points[key.second];
    boxes.push_back({key.first, key.second, std::min(p.x(), q.x()), std::max(p.x(), q.x()),
                     std::min(p.y(), q.y()), std::max(p.y(), q.y())});
  }
  std::sort(boxes.begin(), boxes.end(), [](const Box& i, const Box& k) { return i.left < k.left; });
  std::vector<std::pair<std::pair<int, int>, std::pair<int, int>>> pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i];
    for (std::size_t k = i + 1; k < boxes.size() && boxes[k].left <= box.right; ++k) {
      const Box& other = boxes[k];
      if (other.low > box.high || box.low > other.high) continue;
      if (!meet(points, box.a, box.b, other.a, other.b)) continue;
      pairs.push_back({{box.a, box.b}, {other.a, other.b}});
      if (pairs.size() == most) return pairs;
    }
  }
  return pairs;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace misalign::schema
