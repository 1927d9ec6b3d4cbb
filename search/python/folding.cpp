#include "search/python/folding.hpp"

#include "search/draws/decision_stream.hpp"
#include "search/python/arrays.hpp"
#include "search/python/bindings.hpp"
#include "search/python/made.hpp"
#include "search/python/shift_blocks.hpp"
#include "search/python/signals.hpp"
#include "solver/continuation/path.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;
using Eigen::Index;

constexpr Index kFlat = -1, kBeyond = -2;  // marks instead of a row of the history

// Returns the row of the history for each angle.
std::vector<Index> rows_at(const std::vector<double>& pilot_deg, const solver::Sheet& sheet) {
  std::vector<Index> rows;
  for (const double angle_deg : pilot_deg) {
    rows.push_back(angle_deg <= 0 ? kFlat : sheet.row_at(angle_deg).value_or(kBeyond));
  }
  return rows;
}

py::array_t<double> picked(const std::vector<Index>& rows, const Eigen::MatrixXd& values,
                           const Eigen::VectorXd& flat) {
  py::array_t<double> table({static_cast<Index>(rows.size()), flat.size()});
  auto cells = table.mutable_unchecked<2>();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (Index column = 0; column < flat.size(); ++column) {
      cells(static_cast<Index>(k), column) = rows[k] == kFlat     ? flat(column)
                                             : rows[k] == kBeyond ? std::nan("")
                                                                  : values(rows[k], column);
    }
  }
  return table;
}

py::array_t<double> picked_shapes(const std::vector<Index>& rows, const solver::Sheet& sheet) {
  const Eigen::Matrix2Xd& flat_mm = sheet.vertices_mm();
  const Index vertices = flat_mm.cols();
  py::array_t<double> table({static_cast<Index>(rows.size()), vertices, Index{3}});
  auto cells = table.mutable_unchecked<3>();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (Index v = 0; v < vertices; ++v) {
      Eigen::Vector3d at_mm = Eigen::Vector3d::Constant(std::nan(""));
      if (rows[k] == kFlat) at_mm << flat_mm.col(v), 0;
      if (rows[k] >= 0) at_mm = sheet.shapes_mm()[static_cast<std::size_t>(rows[k])].col(v);
      for (Index axis = 0; axis < 3; ++axis) cells(static_cast<Index>(k), v, axis) = at_mm(axis);
    }
  }
  return table;
}

}  // namespace

py::dict fold(const PatternSource& source, const Eigen::Matrix2Xd& shifts_mm,
              const std::optional<std::vector<double>>& stations_deg) {
  using namespace py::literals;
  const schema::Pattern& base = source.sheet.base;
  const schema::Sampling sampling = sampling_for(stations_deg, source);
  StationOptions stations(0, stations_deg.value_or(std::vector<double>()));
  std::erase(stations.at_deg, 0);  // flat needs no path
  std::optional<FoldingModel> model;
  std::optional<solver::Sheet> sheet;
  unlocked([&] {
    model.emplace(base, sampling, source.sheet.design, stations);
    sheet.emplace(model->sheet(shifts_mm));
    sheet->shapes_mm();
  });
  solver::FoldingHistory history = sheet->history();
  history.verdict = before_closing(sheet->model(), shifts_mm, history.verdict);
  std::vector<double> pilot_deg = stations_deg.value_or(std::vector<double>());
  if (!stations_deg) {
    for (const solver::Station& station : history.stations) pilot_deg.push_back(station.pilot_deg);
  }
  const std::vector<Index> rows = rows_at(pilot_deg, *sheet);
  const auto diagonals = static_cast<Index>(history.flat_mm.size());
  const Eigen::VectorXd flat_mm = Eigen::VectorXd::Map(history.flat_mm.data(), diagonals);
  const Eigen::VectorXd no_creases =
      Eigen::VectorXd::Zero(static_cast<Index>(model->mechanism().creases.size()));
  const schema::FoldingView view(base, *sheet, history);
  schema::Json verdict = schema::verdict_json(view);
  verdict["bump_between_samples"] = schema::bump_json(view);
  if (source.campaign) verdict["accepted"] = source.campaign->accepts(history.verdict);
  return py::dict("pilot_deg"_a = list_of(pilot_deg), "shifts_mm"_a = points_of(shifts_mm),
                  "length_mm"_a = picked(rows, history.length_mm, flat_mm),
                  "rate_mm_per_deg"_a =
                      picked(rows, history.slope_mm_per_deg, Eigen::VectorXd::Zero(diagonals)),
                  "fold_angle_deg"_a = picked(rows, history.fold_angle_deg, no_creases),
                  "vertices_mm"_a = picked_shapes(rows, *sheet),
                  "flat_mm"_a = list_of(history.flat_mm),
                  "fold_limit_deg"_a = history.path.fold_limit_deg, "verdict"_a = verdict.dump());
}

void bind_foldings(py::module_& module) {
  module.def("fold",
             made(+[](const PatternSource& source, const py::object& shifts_mm,
                      const py::object& stations) {
               const Eigen::Matrix2Xd shifts =
                   shifts_mm.is_none() ? source.sheet.shifts_mm : shifts_of_one(shifts_mm, source);
               return fold(source, shifts, stations_of(stations));
             }),
             py::arg("sheet"), py::arg("shifts_mm"), py::arg("stations"));
}

}  // namespace misalign::search::python
