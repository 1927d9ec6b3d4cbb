#include "solver/pattern/null_space.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Takes `factor` times the pivot's row from another, entry by entry: zeros cost nothing.
void subtract(RowMatrix& m, Eigen::Index row, Eigen::Index pivot_row,
              const std::vector<int>& columns, double factor) {
  for (const int c : columns) m(row, c) -= factor * m(pivot_row, c);
}

std::vector<int> filled_columns(const RowMatrix& m, Eigen::Index row) {
  std::vector<int> columns;
  for (int c = 0; c < m.cols(); ++c) {
    if (m(row, c) != 0) columns.push_back(c);
  }
  return columns;
}

}  // namespace

NullSpace null_space(RowMatrix m, const std::vector<int>& order, double least_pivot) {
  std::vector<Eigen::Index> row_of(static_cast<std::size_t>(m.cols()), -1);
  Eigen::Index next = 0;
  for (const int column : order) {
    Eigen::Index best = -1;
    double largest = least_pivot;
    for (Eigen::Index r = next; r < m.rows(); ++r) {
      if (std::abs(m(r, column)) <= largest) continue;
      best = r;
      largest = std::abs(m(r, column));
    }
    if (best < 0) {
      for (Eigen::Index r = next; r < m.rows(); ++r) m(r, column) = 0;
      continue;
    }
    if (best != next) m.row(best).swap(m.row(next));
    const double pivot = m(next, column);
    for (Eigen::Index c = 0; c < m.cols(); ++c) m(next, c) /= pivot;
    const std::vector<int> columns = filled_columns(m, next);
    for (Eigen::Index r = 0; r < m.rows(); ++r) {
      if (r == next || m(r, column) == 0) continue;
      subtract(m, r, next, columns, m(r, column));
      m(r, column) = 0;
    }
    row_of[static_cast<std::size_t>(column)] = next++;
  }
  NullSpace space;
  for (int c = 0; c < m.cols(); ++c) {
    if (row_of[static_cast<std::size_t>(c)] < 0) space.free.push_back(c);
  }
  space.basis.setZero(m.cols(), static_cast<Eigen::Index>(space.free.size()));
  for (std::size_t k = 0; k < space.free.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    space.basis(space.free[k], column) = 1;
    for (Eigen::Index c = 0; c < m.cols(); ++c) {
      const Eigen::Index row = row_of[static_cast<std::size_t>(c)];
      if (row >= 0 && m(row, space.free[k]) != 0) space.basis(c, column) = -m(row, space.free[k]);
    }
  }
  return space;
}

Eigen::VectorXd product_in_order(const RowMatrix& matrix, const Eigen::VectorXd& vector) {
  assert(matrix.cols() == vector.size());
  Eigen::VectorXd product(matrix.rows());
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    double sum = 0;
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) sum += matrix(row, k) * vector(k);
    product(row) = sum;
  }
  return product;
}

}  // namespace misalign::solver
