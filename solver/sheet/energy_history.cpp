#include "solver/sheet/energy_history.hpp"

#include <cassert>

#include "solver/verdict/verdict.hpp"

namespace misalign::solver {
namespace {

// Lengths of the diagonals at a station, panel widths.
std::vector<double> lengths_at(const FoldingHistory& history, Eigen::Index row, double width_mm) {
  std::vector<double> lengths;
  for (const double length_mm : history.length_mm.row(row)) lengths.push_back(length_mm / width_mm);
  return lengths;
}

}  // namespace

EnergyHistory energy_history(const Sheet& sheet, const FoldingHistory& history, const Fill& fill) {
  assert(rest_deg(fill) == 0);
  const Mechanism& mechanism = sheet.mechanism();
  const double width_mm = mechanism.panel_width_mm;
  SheetGeometry<double> geometry;
  place(mechanism, sheet.vertices_mm(), geometry);
  std::vector<double> flat = history.flat_mm;
  for (double& length : flat) length /= width_mm;
  EnergyJudge energy(mechanism, {fill});
  Judge diagonals(mechanism);
  energy.begin(flat, &geometry);
  diagonals.begin(flat);
  EnergyHistory found;
  const Eigen::Index in_order = rows_folded_well(mechanism, history);
  bool is_monotone = true;
  for (Eigen::Index row = 0; row < history.length_mm.rows(); ++row) {
    const std::vector<double> lengths = lengths_at(history, row, width_mm);
    const Station& station = history.stations[static_cast<std::size_t>(row)];
    if (station.sample == 0 || row >= in_order) continue;
    is_monotone = is_monotone && diagonals.see(station, nullptr, lengths);
    if (!found.rises_to_the_end) continue;
    energy.look(lengths);
    found.rises_to_the_end = energy.rises();
    if (found.rises_to_the_end) {
      found.deploys_from_sample = station.sample;
      energy.take();
    } else {
      found.where = energy.pulls_back();
    }
  }
  found.monotone_to_sample = diagonals.samples_in_order();
  if (in_order == 0) return found;  // the sides of its diagonals are not known
  for (Eigen::Index row = 0; row < history.length_mm.rows(); ++row) {
    found.energy_n_mm.push_back(energy.energy_n_mm(lengths_at(history, row, width_mm)));
  }
  return found;
}

}  // namespace misalign::solver
