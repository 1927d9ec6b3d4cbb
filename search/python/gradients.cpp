// `_misalign.gradient`: how lengths, fold angles and fold limit change with where the vertices lie.
#include <limits>

#include "search/python/arrays.hpp"
#include "search/python/bindings.hpp"
#include "search/python/pattern_source.hpp"
#include "search/python/signals.hpp"
#include "search/python/stations.hpp"
#include "solver/design/path_gradients.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;
using Eigen::Index;
using Eigen::MatrixXd;

struct Gradients {
  std::vector<solver::AngleGradients> angles;
  std::optional<solver::LimitGradient> limit;
};

Gradients gradients_of(const PatternSource& source, const std::vector<double>& stations_deg) {
  Subject subject(source.sheet, {});
  const solver::Sheet& sheet = subject.sheet;
  if (sheet.model().has_spare_equations() || !sheet.way()) {
    throw schema::UserError(schema::Cause::failure,
                            sheet.name() +
                                ": has no gradients (its path is lost, or it has fewer "
                                "holes than count to one degree of freedom)");
  }
  solver::PathGradients gradients(sheet);
  Gradients all{{}, gradients.fold_limit()};
  for (const double pilot_deg : stations_deg) {
    const bool is_on = pilot_deg <= sheet.way()->end_deg();
    auto found = is_on ? gradients.at(pilot_deg) : std::nullopt;
    if (!found) {  // beyond its end: no numbers
      found = gradients.at(0).value();
      const double none = std::numeric_limits<double>::quiet_NaN();
      found->length_mm.setConstant(none), found->length_by_mm.setConstant(none);
      found->fold_deg.setConstant(none), found->fold_by_mm.setConstant(none);
    }
    all.angles.push_back(std::move(*found));
  }
  return all;
}

// [S, rows, V, 2], of x and y of each vertex in turn.
py::array_t<double> by_vertex(const std::vector<solver::AngleGradients>& angles,
                              MatrixXd solver::AngleGradients::*member) {
  const MatrixXd& first = angles.front().*member;
  py::array_t<double> table({std::ssize(angles), first.rows(), first.cols() / 2, Index{2}});
  auto cells = table.mutable_unchecked<4>();
  for (Index s = 0; s < std::ssize(angles); ++s) {
    const MatrixXd& rows = angles[static_cast<std::size_t>(s)].*member;
    for (Index row = 0; row < rows.rows(); ++row) {
      for (Index k = 0; k < rows.cols(); ++k) cells(s, row, k / 2, k % 2) = rows(row, k);
    }
  }
  return table;
}

py::array_t<double> numbers(const std::vector<solver::AngleGradients>& angles,
                            Eigen::VectorXd solver::AngleGradients::*member) {
  py::array_t<double> table({std::ssize(angles), (angles.front().*member).size()});
  auto cells = table.mutable_unchecked<2>();
  for (Index s = 0; s < cells.shape(0); ++s) {
    for (Index k = 0; k < cells.shape(1); ++k) {
      cells(s, k) = (angles[static_cast<std::size_t>(s)].*member)(k);
    }
  }
  return table;
}

py::dict gradient(const PatternSource& source, const py::object& stations) {
  const auto stations_deg = stations_of(stations);
  if (!stations_deg) {
    throw schema::UserError(schema::Cause::bad_request,
                            "stations: are not given; name pilot angles in degrees");
  }
  const Gradients all = unlocked([&] { return gradients_of(source, *stations_deg); });
  py::dict found;
  found["pilot_deg"] = list_of(*stations_deg);
  found["length_mm"] = numbers(all.angles, &solver::AngleGradients::length_mm);
  found["length_by_mm"] = by_vertex(all.angles, &solver::AngleGradients::length_by_mm);
  found["fold_deg"] = numbers(all.angles, &solver::AngleGradients::fold_deg);
  found["fold_by_mm"] = by_vertex(all.angles, &solver::AngleGradients::fold_by_mm);
  found["fold_limit_deg"] = py::none();
  found["fold_limit_by_mm"] = py::none();
  if (all.limit) {
    found["fold_limit_deg"] = all.limit->fold_limit_deg;
    found["fold_limit_by_mm"] = points_of(Eigen::Map<const Eigen::Matrix2Xd>(
        all.limit->by_mm.data(), 2, all.limit->by_mm.size() / 2));
  }
  return found;
}

}  // namespace

void bind_gradients(py::module_& module) {
  module.def("gradient", &gradient, py::arg("sheet"), py::arg("stations"));
}

}  // namespace misalign::search::python
