#include "solver/pattern/miura.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace misalign::solver {
namespace {

int vertex_index(const MiuraShape& shape, int i, int j) { return i * (shape.columns() + 1) + j; }

}  // namespace

MiuraShape MiuraShape::uniform(int rows, int columns, double width_mm, double height_mm,
                               double offset_mm) {
  return {std::vector<double>(columns, width_mm), std::vector<double>(rows, height_mm),
          std::vector<double>(rows, offset_mm)};
}

CreasePattern miura_sheet(const MiuraShape& shape) {
  const int m = shape.rows(), n = shape.columns();
  assert(m > 0 && n > 0);
  assert(shape.height_mm.size() == shape.offset_mm.size());
  std::vector<double> x(n + 1, 0), y(m + 1, 0), shift(m + 1, 0);
  for (int j = 0; j < n; ++j) x[j + 1] = x[j] + shape.width_mm[j];
  for (int i = 0; i < m; ++i) {
    y[i + 1] = y[i] + shape.height_mm[i];
    shift[i + 1] = shift[i] + (i % 2 == 0 ? 1 : -1) * shape.offset_mm[i];
  }
  const auto [least, most] = std::minmax_element(shift.begin(), shift.end());
  CreasePattern sheet;
  sheet.panel_width_mm = std::accumulate(shape.width_mm.begin(), shape.width_mm.end(), 0.0) / n;
  sheet.vertices_mm.resize(2, (m + 1) * (n + 1));
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double aside = j == 0 ? *least : j == n ? *most : shift[i];
      sheet.vertices_mm.col(vertex_index(shape, i, j)) = Eigen::Vector2d(x[j] + aside, y[i]);
    }
  }
  for (int r = 0; r < m; ++r) {
    for (int c = 0; c < n; ++c) {
      sheet.facets.push_back({vertex_index(shape, r, c), vertex_index(shape, r, c + 1),
                              vertex_index(shape, r + 1, c + 1), vertex_index(shape, r + 1, c)});
      sheet.places.push_back({r, c});
    }
  }
  sheet.edges = edges_of(sheet.facets);
  return sheet;
}

std::vector<int> miura_assignment(const MiuraShape& shape, const CreasePattern& sheet) {
  const auto zigzag_sign = [](int j) { return j % 2 == 1 ? 1 : -1; };
  std::vector<int> assignment(sheet.edges.size(), 0);
  assert(sheet.facet_count() == shape.rows() * shape.columns());
  const auto sign = [&](int i, int j, int to_i, int to_j) -> int& {
    return assignment[find_edge(sheet, vertex_index(shape, i, j), vertex_index(shape, to_i, to_j))];
  };
  for (int i = 0; i < shape.rows(); ++i) {
    for (int j = 1; j < shape.columns(); ++j) sign(i, j, i + 1, j) = zigzag_sign(j);
  }
  for (int i = 1; i < shape.rows(); ++i) {
    for (int j = 0; j < shape.columns(); ++j) {
      sign(i, j, i, j + 1) = (j == 0 ? -zigzag_sign(1) : zigzag_sign(j)) * (i % 2 == 1 ? 1 : -1);
    }
  }
  return assignment;
}

}  // namespace misalign::solver
