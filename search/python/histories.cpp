#include "search/python/histories.hpp"

#include <algorithm>
#include <limits>

#include "search/python/arrays.hpp"
#include "search/python/signals.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search::python {

namespace py = pybind11;

namespace {

// Size of a block: large blocks keep the lanes busy; memory limits large sheets.
std::size_t histories_at_once(const solver::Model& model) {
  constexpr std::size_t kBytes = 16 << 20, kFewest = 8, kMost = 64;
  const solver::Mechanism& mechanism = model.mechanism();
  const std::size_t numbers = 2 * mechanism.diagonals.size() + mechanism.creases.size();
  const std::size_t bytes = sizeof(double) * numbers * model.path().stations.size();
  return std::clamp(kBytes / bytes, kFewest, kMost);
}

std::vector<double> seen_deg(const solver::PathPlan& path) {
  std::vector<double> stations_deg;
  for (const solver::Station& station : path.stations) {
    if (station.visit) stations_deg.push_back(station.pilot_deg);
  }
  return stations_deg;
}

}  // namespace

py::tuple histories_of(const PatternSource& source,
                       const std::vector<Eigen::Matrix2Xd>& shifts_mm) {
  const schema::Sampling& sampling = source.sheet.sampling;
  std::optional<solver::Model> model;
  std::unique_ptr<solver::Batch> batch;
  unlocked([&] {
    model.emplace(source.sheet.base.base, solver::all_vertices(source.pattern()),
                  solver::PathPlanOptions{sampling.sample_deg, sampling.end_deg}, 0,
                  source.criterion);
    batch = solver::make_batch(solver::available_instruction_sets().back(), *model);
  });
  const std::vector<double> stations_deg = seen_deg(model->path());
  const std::size_t diagonals = model->mechanism().diagonals.size();
  py::array_t<double> lengths_mm({shifts_mm.size(), stations_deg.size(), diagonals});
  double* to = lengths_mm.mutable_data();
  solver::ShiftBlock block;
  const std::size_t at_once = histories_at_once(*model);
  for (std::size_t first = 0; first < shifts_mm.size(); first += at_once) {
    const std::size_t last = std::min(first + at_once, shifts_mm.size());
    unlocked([&] {
      block.shifts_mm.clear();
      block.sheets = static_cast<int>(last - first);
      for (std::size_t k = first; k < last; ++k) {
        const Eigen::Matrix2Xd& one_mm = shifts_mm[k];
        block.shifts_mm.insert(block.shifts_mm.end(), one_mm.data(), one_mm.data() + one_mm.size());
      }
      for (const solver::FoldingHistory& history : batch->record_lengths(block)) {
        const auto solved = static_cast<std::size_t>(history.length_mm.rows());
        for (std::size_t row = 0; row < stations_deg.size(); ++row) {
          for (std::size_t d = 0; d < diagonals; ++d) {
            *to++ = row < solved ? history.length_mm(static_cast<Eigen::Index>(row),
                                                     static_cast<Eigen::Index>(d))
                                 : std::numeric_limits<double>::quiet_NaN();
          }
        }
      }
    });
    check_signals();
  }
  return py::make_tuple(list_of(stations_deg), lengths_mm);
}

}  // namespace misalign::search::python
