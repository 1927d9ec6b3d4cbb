// Converts between NumPy arrays and the solver's numbers.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::search::python {

/// Returns whether an array, or one in a list, has masked entries.
inline bool is_masked(const pybind11::handle& given) {
  namespace py = pybind11;
  if (py::isinstance<py::array>(given)) {
    return py::module_::import("numpy").attr("ma").attr("is_masked")(given).cast<bool>();
  }
  return (py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given)) &&
         std::any_of(given.begin(), given.end(), is_masked);
}

/// Converts a caller's numbers with the NumPy function `maker`. UserError (bad_request) if some are
/// masked: NumPy would take the values under the mask.
inline pybind11::array array_of_given(const pybind11::object& given, const char* name,
                                      const char* maker = "asarray") {
  if (is_masked(given)) {
    throw schema::UserError(
        schema::Cause::bad_request,
        std::string(name) +
            ": has masked entries (they hold no numbers); fill them, or omit those rows");
  }
  return pybind11::module_::import("numpy").attr(maker)(given);
}

/// Converts to contiguous numbers of one type. NumPy's errors, such as of memory, become Python's:
/// `ensure` would return null.
template <class Value>
pybind11::array_t<Value, pybind11::array::c_style | pybind11::array::forcecast> numbers_of(
    const pybind11::array& array) {
  return pybind11::array_t<Value, pybind11::array::c_style | pybind11::array::forcecast>(
      pybind11::object(array));
}

/// Returns a table with a row for each entry.
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

/// Converts 2 x vertices to [V, 2].
inline pybind11::array_t<double> points_of(const Eigen::Matrix2Xd& columns) {
  return pybind11::array_t<double>({columns.cols(), Eigen::Index{2}}, columns.data());
}

}  // namespace misalign::search::python
