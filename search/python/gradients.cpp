// Binds `_misalign.gradient`: derivatives of lengths, slopes, fold angles, folded vertices and the
// fold limit by the vertices' coordinates.
#include <limits>

#include "search/python/arrays.hpp"
#include "search/python/bindings.hpp"
#include "search/python/made.hpp"
#include "search/python/pattern_source.hpp"
#include "search/python/signals.hpp"
#include "search/python/stations.hpp"
#include "search/sheets/studies.hpp"
#include "solver/optimise/path_gradients.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;
using namespace py::literals;
using Eigen::Index;
using Eigen::MatrixXd;

struct Gradients {
  std::vector<solver::PathGradients::AtAngle> angles;
  std::vector<solver::PathGradients::Slopes> slopes;
  std::vector<solver::PathGradients::Shape> vertices;
  std::optional<solver::PathGradients::AtLimit> limit;
};

Gradients gradients_of(const PatternSource& source, const std::vector<double>& stations_deg) {
  Subject subject(source.sheet, {});
  const solver::Sheet& sheet = subject.sheet;
  const bool is_overconstrained = sheet.model().is_overconstrained();
  if (is_overconstrained || !sheet.way()) {
    throw study_error(
        is_overconstrained ? solver::NoResult::overconstrained : solver::NoResult::path_lost,
        sheet.name(), "it has no gradients");
  }
  solver::PathGradients gradients(sheet);
  Gradients all{{}, {}, {}, gradients.fold_limit()};
  const Index coordinates = 2 * sheet.shifts_mm().cols();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const double pilot_deg : stations_deg) {
    watch_signals();
    const bool is_on = pilot_deg <= sheet.way()->end_deg();
    auto found = is_on ? gradients.at(pilot_deg) : std::nullopt;
    if (!found) {  // no values beyond the path's end
      found = gradients.at(0).value();
      found->length_mm.setConstant(none), found->length_by_mm.setConstant(none);
      found->fold_deg.setConstant(none), found->fold_by_mm.setConstant(none);
    }
    const Index diagonals = found->length_mm.size(), heights = 3 * coordinates / 2;
    all.angles.push_back(std::move(*found));
    // There are no slopes at the end of a way, and no shapes at its start.
    auto slopes = is_on ? gradients.slopes(pilot_deg) : std::nullopt;
    all.slopes.push_back(
        slopes ? std::move(*slopes)
               : solver::PathGradients::Slopes{Eigen::VectorXd::Constant(diagonals, none),
                                               MatrixXd::Constant(diagonals, coordinates, none)});
    auto vertices = is_on && pilot_deg > 0 ? gradients.vertices(pilot_deg) : std::nullopt;
    all.vertices.push_back(vertices ? std::move(*vertices)
                                    : solver::PathGradients::Shape{
                                          Eigen::Matrix3Xd::Constant(3, coordinates / 2, none),
                                          MatrixXd::Constant(heights, coordinates, none)});
  }
  return all;
}

// Returns [S, rows, V, 2], for x and y of each vertex in turn.
template <class OfAngle>
py::array_t<double> by_vertex(const std::vector<OfAngle>& angles, MatrixXd OfAngle::*member) {
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

template <class OfAngle>
py::array_t<double> numbers(const std::vector<OfAngle>& angles, Eigen::VectorXd OfAngle::*member) {
  py::array_t<double> table({std::ssize(angles), (angles.front().*member).size()});
  auto cells = table.mutable_unchecked<2>();
  for (Index s = 0; s < cells.shape(0); ++s) {
    for (Index k = 0; k < cells.shape(1); ++k) {
      cells(s, k) = (angles[static_cast<std::size_t>(s)].*member)(k);
    }
  }
  return table;
}

// Returns [S, V, 3], and [S, V, 3, V, 2].
py::array_t<double> places(const std::vector<solver::PathGradients::Shape>& angles) {
  py::array_t<double> table({std::ssize(angles), angles.front().at_mm.cols(), Index{3}});
  auto cells = table.mutable_unchecked<3>();
  for (Index s = 0; s < cells.shape(0); ++s) {
    const Eigen::Matrix3Xd& at_mm = angles[static_cast<std::size_t>(s)].at_mm;
    for (Index v = 0; v < at_mm.cols(); ++v) {
      for (Index axis = 0; axis < 3; ++axis) cells(s, v, axis) = at_mm(axis, v);
    }
  }
  return table;
}

py::dict gradient(const PatternSource& source, const py::object& stations) {
  const auto stations_deg = stations_of(stations);
  if (!stations_deg) {
    throw schema::UserError(schema::Cause::bad_request,
                            "stations: are not given; give pilot angles in degrees");
  }
  const Gradients all = unlocked([&] { return gradients_of(source, *stations_deg); });
  py::dict found;
  found["pilot_deg"] = list_of(*stations_deg);
  found["length_mm"] = numbers(all.angles, &solver::PathGradients::AtAngle::length_mm);
  found["length_by_mm"] = by_vertex(all.angles, &solver::PathGradients::AtAngle::length_by_mm);
  found["fold_deg"] = numbers(all.angles, &solver::PathGradients::AtAngle::fold_deg);
  found["fold_by_mm"] = by_vertex(all.angles, &solver::PathGradients::AtAngle::fold_by_mm);
  found["slope_mm_per_rad"] = numbers(all.slopes, &solver::PathGradients::Slopes::slope_mm_per_rad);
  found["slope_by_mm"] = by_vertex(all.slopes, &solver::PathGradients::Slopes::slope_by_mm);
  found["folded_mm"] = places(all.vertices);
  const Index stations_n = std::ssize(*stations_deg),
              vertices_n = all.vertices.front().at_mm.cols();
  found["folded_by_mm"] = by_vertex(all.vertices, &solver::PathGradients::Shape::by_mm)
                              .reshape({stations_n, vertices_n, Index{3}, vertices_n, Index{2}});
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
  module.def("gradient", made(&gradient), "sheet"_a, "stations"_a);
}

}  // namespace misalign::search::python
