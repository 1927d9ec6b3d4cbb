// Meshes quadrilateral panels with eight-node elements; panels share no nodes.
#pragma once

#include <array>

namespace misalign::schema {

/// Numbers count from 1, as in finite-element programs. A panel's nodes lie on a grid of
/// (2 n + 1) x (2 n + 1) without the elements' middles; corner 0 of the panel is at (0, 0), corner
/// 1 at (2 n, 0), corner 2 at (2 n, 2 n).
class PanelMesh {
 public:
  explicit PanelMesh(int elements) : elements_(elements) {}

  int elements() const { return elements_; }
  int side() const { return 2 * elements_; }
  int elements_of_a_panel() const { return elements_ * elements_; }
  bool has_node(int i, int j) const { return i % 2 == 0 || j % 2 == 0; }
  int node(int panel, int i, int j) const {
    return 1 + panel * (side() + 1) * (side() + 1) + j * (side() + 1) + i;
  }
  int panel_of_node(int node) const { return (node - 1) / ((side() + 1) * (side() + 1)); }
  int element(int panel, int i, int j) const {
    return 1 + panel * elements_of_a_panel() + j * elements_ + i;
  }
  int panel_of_element(int element) const { return (element - 1) / elements_of_a_panel(); }

  /// Corner nodes counter-clockwise, then mid-side nodes.
  std::array<int, 8> nodes_of_element(int panel, int i, int j) const {
    const auto at = [&](int di, int dj) { return node(panel, 2 * i + di, 2 * j + dj); };
    return {at(0, 0), at(2, 0), at(2, 2), at(0, 2), at(1, 0), at(2, 1), at(1, 2), at(0, 1)};
  }
  /// The `step`-th node, 0 to side(), on the edge from a corner of a panel to one of its
  /// neighbours.
  int node_on_edge(int panel, int from_corner, int to_corner, int step) const {
    const auto [i0, j0] = place(from_corner);
    const auto [i1, j1] = place(to_corner);
    return node(panel, i0 + (i1 - i0) * step / side(), j0 + (j1 - j0) * step / side());
  }
  int corner_node(int panel, int corner) const {
    const auto [i, j] = place(corner);
    return node(panel, i, j);
  }

 private:
  std::array<int, 2> place(int corner) const {
    const int n = side();
    constexpr std::array<std::array<int, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    return {kCorners[corner][0] * n, kCorners[corner][1] * n};
  }

  int elements_;
};

}  // namespace misalign::schema
