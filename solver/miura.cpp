#include "solver/miura.hpp"

#include <cmath>

namespace misalign::solver {
namespace {

int vertex_index(const MiuraShape& shape, int i, int j) { return i * (shape.columns + 1) + j; }

}  // namespace

CreasePattern miura_sheet(const MiuraShape& shape) {
  const int m = shape.rows, n = shape.columns;
  CreasePattern sheet;
  sheet.panel_width_mm = shape.panel_width_mm;
  sheet.vertices_mm.resize(2, (m + 1) * (n + 1));
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= n; ++j) {
      const bool shifted = j == n || (i % 2 == 1 && j > 0);
      sheet.vertices_mm.col(vertex_index(shape, i, j)) =
          Eigen::Vector2d(shape.panel_width_mm * j + (shifted ? shape.zigzag_offset_mm : 0.0),
                          shape.panel_height_mm * i);
    }
  }
  for (int r = 0; r < m; ++r) {
    for (int c = 0; c < n; ++c) {
      sheet.facets.push_back({vertex_index(shape, r, c), vertex_index(shape, r, c + 1),
                              vertex_index(shape, r + 1, c + 1), vertex_index(shape, r + 1, c)});
    }
  }
  sheet.edges = edges_of(sheet.facets);
  return sheet;
}

BaseFolding miura_folding(const MiuraShape& shape, const CreasePattern& sheet) {
  const double cos_alpha =
      shape.zigzag_offset_mm / std::hypot(shape.zigzag_offset_mm, shape.panel_height_mm);
  const auto zigzag_sign = [](int j) { return j % 2 == 1 ? 1 : -1; };
  BaseFolding folding{std::vector<double>(sheet.edges.size(), 0.0), -1};
  const auto ratio = [&](int i, int j, int to_i, int to_j) -> double& {
    return folding.tangent_ratio[find_edge(sheet, vertex_index(shape, i, j),
                                           vertex_index(shape, to_i, to_j))];
  };
  for (int i = 0; i < shape.rows; ++i) {
    for (int j = 1; j < shape.columns; ++j) ratio(i, j, i + 1, j) = zigzag_sign(j);
  }
  for (int i = 1; i < shape.rows; ++i) {
    for (int j = 0; j < shape.columns; ++j) {
      const int sign = (j == 0 ? -zigzag_sign(1) : zigzag_sign(j)) * (i % 2 == 1 ? 1 : -1);
      ratio(i, j, i, j + 1) = sign * cos_alpha;
    }
  }
  folding.pilot_edge = find_edge(sheet, vertex_index(shape, 0, 1), vertex_index(shape, 1, 1));
  return folding;
}

std::vector<int> checkerboard(const MiuraShape& shape, int remainder) {
  std::vector<int> holes;
  for (int r = 1; r < shape.rows - 1; ++r) {
    for (int c = 1; c < shape.columns - 1; ++c) {
      if ((r + c) % 2 == remainder) holes.push_back(r * shape.columns + c);
    }
  }
  return holes;
}

}  // namespace misalign::solver
