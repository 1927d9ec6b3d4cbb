#include "solver/play/miscut_stops.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "solver/studies/angle_of_use.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The energy of a filling at one station, and its rate by the pilot angle.
struct DrivenStation {
  double pilot_deg, energy_n_mm, n_mm_per_deg;
};

DrivenStation station_at(const FoldingHistory& history, const Filling& filling, Index row) {
  assert(row >= 0 && row < history.length_mm.rows());
  const VectorXd lengths_mm = history.length_mm.row(row);
  return {history.stations[static_cast<std::size_t>(row)].pilot_deg,
          filling.energy_n_mm(lengths_mm),
          filling.forces_n(lengths_mm).dot(history.slope_mm_per_deg.row(row))};
}

// The minimum of the cubic through both energies and rates: the energy falls at the lower station
// and rises at the upper one, so that its rate, a parabola, has one root between them.
double minimum_deg(const DrivenStation& low, const DrivenStation& high) {
  const double step_deg = high.pilot_deg - low.pilot_deg;
  const double start = low.n_mm_per_deg * step_deg, end = high.n_mm_per_deg * step_deg;
  assert(step_deg > 0 && start <= 0 && end > 0);
  const double rise = high.energy_n_mm - low.energy_n_mm;
  const double bend = 3 * (start + end) - 6 * rise, slope = end - start - bend;
  // bend t^2 + slope t + start = 0, by the form that does not cancel.
  const double root = std::sqrt(std::max(slope * slope - 4 * bend * start, 0.0));
  const double t = slope >= 0 ? -2 * start / (slope + root) : (root - slope) / (2 * bend);
  return low.pilot_deg + std::clamp(t, 0.0, 1.0) * step_deg;
}

}  // namespace

void MiscutStops::add(const std::optional<double>& stop_deg) {
  if (!stop_deg) {
    ++held;
  } else if (*stop_deg == 0) {
    ++flat;
  } else {
    stops_deg.insert(std::ranges::upper_bound(stops_deg, *stop_deg), *stop_deg);
  }
}

void MiscutStops::add(const MiscutStops& others) {
  std::vector<double> merged;
  std::ranges::merge(stops_deg, others.stops_deg, std::back_inserter(merged));
  stops_deg = std::move(merged);
  flat += others.flat;
  held += others.held;
}

double MiscutStops::quantile_deg(double share) const {
  assert(share >= 0 && share <= 1 && !stops_deg.empty());
  const double wanted = std::max(std::ceil(share * static_cast<double>(stops_deg.size())), 1.0);
  return stops_deg[static_cast<std::size_t>(wanted) - 1];
}

std::optional<double> stop_deg(const FoldingHistory& history, const Filling& filling,
                               double from_deg) {
  const auto beyond = std::ranges::find_if(history.stations, [&](const Station& station) {
    return station.pilot_deg > from_deg + kSameAngle_deg;
  });
  Index row = beyond - history.stations.begin() - 1;
  if (row < 0) return {};
  DrivenStation high = station_at(history, filling, row);
  if (high.pilot_deg < from_deg - kSameAngle_deg && beyond == history.stations.end()) return {};
  if (!(high.n_mm_per_deg > 0)) return {};
  while (row > 0) {
    const DrivenStation low = station_at(history, filling, --row);
    if (low.n_mm_per_deg <= 0) return minimum_deg(low, high);
    high = low;
  }
  return 0;
}

}  // namespace misalign::solver
