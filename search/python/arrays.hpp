// NumPy arrays from what the solver counts and measures.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace misalign::search::python {

/// A row for each entry, of equal length.
template <class Value, std::size_t Columns>
pybind11::array_t<Value> table_of(const std::vector<std::array<Value, Columns>>& rows) {
  pybind11::array_t<Value> table({rows.size(), Columns});
  auto cells = table.template mutable_unchecked<2>();
  for (pybind11::ssize_t row = 0; row < cells.shape(0); ++row) {
    for (pybind11::ssize_t column = 0; column < cells.shape(1); ++column) {
      cells(row, column) = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
  }
  return table;
}

template <class Value>
pybind11::array_t<Value> list_of(const std::vector<Value>& values) {
  return pybind11::array_t<Value>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

/// 2 x vertices as [V, 2].
inline pybind11::array_t<double> points_of(const Eigen::Matrix2Xd& columns) {
  return pybind11::array_t<double>({columns.cols(), Eigen::Index{2}}, columns.data());
}

}  // namespace misalign::search::python
