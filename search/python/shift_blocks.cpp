#include "search/python/shift_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/pattern/pattern_file.hpp"
#include "search/python/arrays.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;

schema::UserError no_shifts(const std::string& why, const std::string& form) {
  return schema::UserError(schema::Cause::bad_request, "shifts_mm: " + why + "; give " + form);
}

std::string shape_of(const py::array& array) {
  std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
  return fmt::format("[{}]", fmt::join(shape, ", "));
}

py::array array_of(const py::object& shifts_mm, const std::vector<py::ssize_t>& shape,
                   const std::string& form) {
  const py::array array = array_of_given(shifts_mm, "shifts_mm");
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    throw no_shifts("holds values that are no numbers", form);
  const auto axes = static_cast<py::ssize_t>(shape.size());
  bool fits = array.ndim() == axes;
  for (py::ssize_t axis = 0; fits && axis < axes; ++axis) {
    const py::ssize_t wanted = shape[static_cast<std::size_t>(axis)];
    fits = wanted < 0 || array.shape(axis) == wanted;
  }
  if (!fits) throw no_shifts("has the shape " + shape_of(array), form);
  return array;
}

std::string form_of(const PatternSource& source, const char* sheets) {
  return fmt::format("x and y in mm of each of the {} vertices of the sheet, [{}{}, 2]",
                     source.vertices(), sheets, source.vertices());
}

void check(const PatternSource& source, const Eigen::Matrix2Xd& shifts_mm,
           const std::string& whose) {
  for (Eigen::Index v = 0; v < shifts_mm.cols(); ++v) {
    if (shifts_mm.col(v).allFinite()) continue;
    throw schema::UserError(schema::Cause::bad_request,
                            fmt::format("shifts_mm: {}vertex {} is shifted by [{}, {}], which are "
                                        "not both finite; give finite numbers, in mm",
                                        whose, solver::vertex_label(static_cast<int>(v)),
                                        shifts_mm(0, v), shifts_mm(1, v)));
  }
  const auto bad =
      solver::nonconvex_facets(source.pattern(), source.pattern().vertices_mm + shifts_mm);
  if (bad.empty()) return;
  throw schema::UserError(
      schema::Cause::bad_request,
      fmt::format("shifts_mm: {}the shifts make the facet {} nonconvex; shift vertices by a small "
                  "part of a panel",
                  whose, schema::facet_json(source.sheet.base, bad.front()).dump()));
}

}  // namespace

ShiftBlocks::ShiftBlocks(const py::object& shifts_mm, const PatternSource& source)
    : source_(source),
      array_(array_of(shifts_mm, {-1, source.vertices(), 2}, form_of(source, "N, "))),
      is_ready_(py::array_t<double, py::array::c_style>::check_(array_)),
      sheets_(static_cast<std::uint64_t>(array_.shape(0))),
      per_sheet_(2 * static_cast<std::size_t>(source.vertices())) {}

const double* ShiftBlocks::rows(std::uint64_t first, std::uint64_t count) {
  if (is_ready_) return static_cast<const double*>(array_.data()) + first * per_sheet_;
  const py::slice some(static_cast<py::ssize_t>(first), static_cast<py::ssize_t>(first + count), 1);
  made_ = numbers_of<double>(py::array(array_[some]));
  return made_.data();
}

double ShiftBlocks::ternary_mm() {
  constexpr std::uint64_t kFirst = 256;
  const std::uint64_t count = std::min(kFirst, sheets_);
  if (count == 0) return 0;
  const double* const from = rows(0, count);
  double amplitude_mm = 0;
  for (const double* at = from; at != from + count * per_sheet_; ++at) {
    if (*at == 0) continue;
    if (amplitude_mm == 0) amplitude_mm = std::abs(*at);
    if (!(std::abs(*at) == amplitude_mm)) return 0;
  }
  return amplitude_mm < source_.safe_mm ? amplitude_mm : 0;
}

bool ShiftBlocks::pack(const double* rows, std::uint64_t first, std::uint64_t count,
                       const std::vector<int>& shifted, Draws& block) const {
  const double safe_mm = source_.safe_mm;
  block.clear();
  std::vector<char> is_packed(per_sheet_ / 2, 0);
  for (const int vertex : shifted) is_packed[static_cast<std::size_t>(vertex)] = 1;
  std::vector<std::size_t> others;
  for (std::size_t v = 0; v < is_packed.size(); ++v) {
    if (!is_packed[v]) others.push_back(v);
  }
  block.shifts.shifts_mm.resize(count * 2 * shifted.size());
  double* to = block.shifts.shifts_mm.data();
  for (std::uint64_t k = 0; k < count; ++k, rows += per_sheet_) {
    bool is_safe = true, is_shifted_elsewhere = false;
    for (const int vertex : shifted) {
      const double x = rows[2 * vertex], y = rows[2 * vertex + 1];
      is_safe &= std::abs(x) < safe_mm && std::abs(y) < safe_mm;  // false for NaN
      *to++ = x;
      *to++ = y;
    }
    for (const std::size_t v : others) {
      is_shifted_elsewhere |= rows[2 * v] != 0 || rows[2 * v + 1] != 0;
    }
    if (!is_safe || is_shifted_elsewhere) check_sheet(rows, first + k);
    if (is_shifted_elsewhere) {
      block.clear();
      return false;
    }
    block.numbers.push_back(first + k);
  }
  block.shifts.sheets = static_cast<int>(count);
  return true;
}

void ShiftBlocks::check_sheet(const double* row, std::uint64_t number) const {
  check(source_, Eigen::Map<const Eigen::Matrix2Xd>(row, 2, source_.vertices()),
        fmt::format("of sheet {} ", number));
}

Eigen::Matrix2Xd shifts_of_one(const py::object& shifts_mm, const PatternSource& source) {
  const py::array array = array_of(shifts_mm, {source.vertices(), 2}, form_of(source, ""));
  const auto doubles = numbers_of<double>(array);
  const Eigen::Matrix2Xd columns =
      Eigen::Map<const Eigen::Matrix2Xd>(doubles.data(), 2, source.vertices());
  check(source, columns, "");
  return columns;
}

}  // namespace misalign::search::python
