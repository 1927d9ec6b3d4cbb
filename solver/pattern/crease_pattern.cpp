#include "solver/pattern/crease_pattern.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <utility>

namespace misalign::solver {
namespace {

// Twice the signed area of the corner a -> b -> c; positive when it turns left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d in = b - a, out = c - b;
  return in.x() * out.y() - in.y() * out.x();
}

// Returns whether every corner turns left wherever each movable vertex lies in a square of half
// side `a`. The turn is linear in each coordinate, so its least value is taken at corners of the
// squares.
bool stays_convex(const CreasePattern& sheet, const std::vector<bool>& movable, double a) {
  for (const auto& facet : sheet.facets) {
    for (int corner = 0; corner < 4; ++corner) {
      const std::array<int, 3> v = {facet[(corner + 3) % 4], facet[corner],
                                    facet[(corner + 1) % 4]};
      for (int signs = 0; signs < 64; ++signs) {
        std::array<Eigen::Vector2d, 3> p;
        for (int k = 0; k < 3; ++k) {
          p[k] = sheet.vertices_mm.col(v[k]);
          if (!movable[v[k]]) continue;
          p[k].x() += (signs >> (2 * k) & 1) ? a : -a;
          p[k].y() += (signs >> (2 * k + 1) & 1) ? a : -a;
        }
        if (turn(p[0], p[1], p[2]) <= 0) return false;
      }
    }
  }
  return true;
}

}  // namespace

std::vector<Edge> edges_of(const std::vector<std::array<int, 4>>& facets) {
  std::map<std::pair<int, int>, Edge> by_ends;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    for (int k = 0; k < 4; ++k) {
      const int from = facets[f][k], to = facets[f][(k + 1) % 4];
      const int a = std::min(from, to), b = std::max(from, to);
      Edge& edge = by_ends.try_emplace({a, b}, Edge{a, b, -1, -1}).first->second;
      (from == a ? edge.left : edge.right) = f;
    }
  }
  std::vector<Edge> edges;
  for (const auto& [key, edge] : by_ends) edges.push_back(edge);
  return edges;
}

int find_edge(const CreasePattern& sheet, int vertex, int other_vertex) {
  assert(std::min(vertex, other_vertex) >= 0);
  assert(std::max(vertex, other_vertex) < sheet.vertex_count());
  const auto key = std::minmax(vertex, other_vertex);
  const auto at = std::lower_bound(sheet.edges.begin(), sheet.edges.end(), key,
                                   [](const Edge& e, const auto& k) {
                                     return std::pair(e.a, e.b) < std::pair(k.first, k.second);
                                   });
  if (at == sheet.edges.end() || at->a != key.first || at->b != key.second) return -1;
  return static_cast<int>(at - sheet.edges.begin());
}

std::vector<int> facets_around(const CreasePattern& sheet, int vertex) {
  assert(vertex >= 0 && vertex < sheet.vertex_count());
  int first = 0;
  const auto corner_of = [&](int f) {
    const auto& v = sheet.facets[f];
    return static_cast<int>(std::find(v.begin(), v.end(), vertex) - v.begin());
  };
  while (first < sheet.facet_count() && corner_of(first) == 4) ++first;
  std::vector<int> ring;
  for (int f = first; f >= 0 && f < sheet.facet_count();) {
    ring.push_back(f);
    // The next edge to cross is that by which a counter-clockwise facet enters the vertex.
    assert(corner_of(f) < 4);  // else its edges lead past the vertex
    const int before = sheet.facets[f][(corner_of(f) + 3) % 4];
    const Edge& edge = sheet.edges[find_edge(sheet, before, vertex)];
    f = edge.left == f ? edge.right : edge.left;
    if (f == first) return ring;
  }
  return {};
}

std::vector<int> all_vertices(const CreasePattern& sheet) {
  std::vector<int> vertices(static_cast<std::size_t>(sheet.vertex_count()));
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

std::vector<int> interior_vertices(const CreasePattern& sheet) {
  std::vector<bool> on_perimeter(sheet.vertex_count(), false);
  for (const Edge& edge : sheet.edges) {
    if (edge.on_perimeter()) on_perimeter[edge.a] = on_perimeter[edge.b] = true;
  }
  std::vector<int> interior;
  for (int v = 0; v < sheet.vertex_count(); ++v) {
    if (!on_perimeter[v]) interior.push_back(v);
  }
  return interior;
}

std::vector<int> ring_vertices(const CreasePattern& sheet) {
  const std::vector<int> interior = interior_vertices(sheet);
  const auto is_interior = [&](int v) {
    return std::binary_search(interior.begin(), interior.end(), v);
  };
  std::vector<int> ring;
  for (const Edge& edge : sheet.edges) {
    if (is_interior(edge.a) != is_interior(edge.b)) {
      ring.push_back(is_interior(edge.a) ? edge.a : edge.b);
    }
  }
  std::sort(ring.begin(), ring.end());
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

std::string vertex_label(int vertex) { return "A" + std::to_string(vertex + 1); }

std::string line_label(int from, int to) { return vertex_label(from) + "-" + vertex_label(to); }

std::vector<int> nonconvex_facets(const CreasePattern& sheet, const FlatVertices& vertices_mm) {
  assert(vertices_mm.cols() == sheet.vertex_count());
  std::vector<int> bad;
  for (int f = 0; f < sheet.facet_count(); ++f) {
    const auto& v = sheet.facets[f];
    for (int k = 0; k < 4; ++k) {
      if (!(turn(vertices_mm.col(v[(k + 3) % 4]), vertices_mm.col(v[k]),
                 vertices_mm.col(v[(k + 1) % 4])) > 0)) {
        bad.push_back(f);
        break;
      }
    }
  }
  return bad;
}

double largest_safe_amplitude_mm(const CreasePattern& sheet, const std::vector<int>& shifted) {
  std::vector<bool> movable(sheet.vertex_count(), false);
  for (const int v : shifted) movable[v] = true;
  assert(sheet.panel_width_mm > 0);  // else the bisection does not end
  double safe = 0, unsafe = sheet.panel_width_mm + sheet.vertices_mm.cwiseAbs().maxCoeff();
  while (unsafe - safe > 1e-9 * sheet.panel_width_mm) {
    const double middle = 0.5 * (safe + unsafe);
    (stays_convex(sheet, movable, middle) ? safe : unsafe) = middle;
  }
  return safe;
}

}  // namespace misalign::solver
