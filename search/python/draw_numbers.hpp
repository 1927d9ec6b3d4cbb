// Reads numbers of draws from anything that NumPy converts to an array.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <vector>

#include "search/python/arrays.hpp"

namespace misalign::search::python {

/// Reads a number, or a list, range or array of them: whole, 0 to 2^63 - 1. UserError
/// (bad_request).
inline std::vector<std::uint64_t> draw_numbers(const pybind11::object& draws) {
  namespace py = pybind11;
  const auto refuse = [](const std::string& why) {
    return schema::UserError(schema::Cause::bad_request,
                             "draws: " + why + "; give whole numbers from 0 to 2^63 - 1");
  };
  const py::array all = array_of_given(draws, "draws", "atleast_1d");
  if (all.ndim() != 1) throw refuse("has " + std::to_string(all.ndim()) + " axes, not one");
  if (all.size() == 0) return {};
  const char kind = all.dtype().kind();
  if (kind != 'i' && kind != 'u') throw refuse("holds values that are no whole numbers");
  std::vector<std::uint64_t> numbers;
  if (kind == 'u') {
    const auto list = numbers_of<std::uint64_t>(all);
    const auto cells = list.unchecked<1>();
    for (py::ssize_t k = 0; k < cells.shape(0); ++k) numbers.push_back(cells(k));
  } else {
    const auto list = numbers_of<std::int64_t>(all);
    const auto cells = list.unchecked<1>();
    for (py::ssize_t k = 0; k < cells.shape(0); ++k) {
      if (cells(k) < 0) throw refuse("holds " + std::to_string(cells(k)));
      numbers.push_back(static_cast<std::uint64_t>(cells(k)));
    }
  }
  for (const std::uint64_t number : numbers) {
    if (number >> 63) throw refuse("holds " + std::to_string(number));
  }
  return numbers;
}

/// Reads one number.
inline std::uint64_t draw_number(const pybind11::object& draw) {
  const std::vector<std::uint64_t> numbers = draw_numbers(draw);
  if (numbers.size() == 1) return numbers.front();
  throw schema::UserError(
      schema::Cause::bad_request,
      "draw: holds " + std::to_string(numbers.size()) + " numbers; give one, from 0 to 2^63 - 1");
}

}  // namespace misalign::search::python
