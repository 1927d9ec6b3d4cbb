// Describes a quadrilateral mesh on the flat sheet. Vertices and facets are integers; labels (A1,
// A2, ...) exist for people only.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace misalign::solver {

/// 2 x N vertex coordinates on the flat sheet, mm.
using FlatVertices = Eigen::Matrix2Xd;

/// An edge a -> b with a < b and the facets on its two sides seen from +z; -1 outside the sheet.
struct Edge {
  int a, b;
  int left, right;
  bool on_perimeter() const { return left < 0 || right < 0; }
};

struct CreasePattern {
  FlatVertices vertices_mm;
  std::vector<std::array<int, 4>> facets;  ///< corners counter-clockwise seen from +z
  std::vector<std::array<int, 2>> places;  ///< row and column of each facet
  std::vector<Edge> edges;                 ///< sorted by (a, b)
  double panel_width_mm;                   ///< the unit of closure errors and bands

  int vertex_count() const { return static_cast<int>(vertices_mm.cols()); }
  int facet_count() const { return static_cast<int>(facets.size()); }
};

/// Edges of a mesh, sorted by (a, b).
std::vector<Edge> edges_of(const std::vector<std::array<int, 4>>& facets);

/// Index of the edge between two vertices, -1 if there is none.
int find_edge(const CreasePattern& sheet, int vertex, int other_vertex);

/// Facets around a vertex, counter-clockwise; empty for a vertex on the perimeter.
std::vector<int> facets_around(const CreasePattern& sheet, int vertex);

/// Every vertex, ascending.
std::vector<int> all_vertices(const CreasePattern& sheet);

/// Vertices not on the perimeter, ascending.
std::vector<int> interior_vertices(const CreasePattern& sheet);

/// Interior vertices joined by an edge to the perimeter, ascending (the ones Table 1 shifts).
std::vector<int> ring_vertices(const CreasePattern& sheet);

/// "A1" for vertex 0.
std::string vertex_label(int vertex);

/// "A17-A23" for vertices 16 and 22.
std::string line_label(int from, int to);

/// Facets (by index) that are not strictly convex, counter-clockwise quadrilaterals at the
/// vertices.
std::vector<int> nonconvex_facets(const CreasePattern& sheet, const FlatVertices& vertices_mm);

/// The largest amplitude a (mm) such that no facet can lose convexity while each of the `shifted`
/// vertices moves by up to a along x and along y. Within 1e-9 panel widths.
double largest_safe_amplitude_mm(const CreasePattern& sheet, const std::vector<int>& shifted);

}  // namespace misalign::solver
