#include "solver/play/miscut_stops.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/studies/angle_of_use.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;

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

std::vector<DrivenStation> driven_stations(const FoldingHistory& history, const Filling& filling,
                                           double friction_n_mm_per_mm) {
  std::vector<DrivenStation> driven;
  const std::size_t count = history.stations.size();
  assert(history.length_mm.rows() == static_cast<Index>(count));
  const auto degree = [&](std::size_t k) { return history.stations[k].pilot_deg; };
  for (std::size_t k = 0; k < count; ++k) {
    const auto row = static_cast<Index>(k);
    const Eigen::VectorXd lengths_mm = history.length_mm.row(row);
    driven.push_back({degree(k), filling.energy_n_mm(lengths_mm),
                      filling.forces_n(lengths_mm).dot(history.slope_mm_per_deg.row(row))});
    if (friction_n_mm_per_mm == 0 || count < 2) continue;
    const std::size_t below = k == 0 ? 0 : k - 1, above = std::min(k + 1, count - 1);
    driven.back().energy_n_mm -= friction_n_mm_per_mm * history.turning_mm[k];
    driven.back().n_mm_per_deg -= friction_n_mm_per_mm *
                                  (history.turning_mm[above] - history.turning_mm[below]) /
                                  (degree(above) - degree(below));
  }
  return driven;
}

std::optional<double> stop_deg(const std::vector<DrivenStation>& stations, double from_deg) {
  const auto beyond = std::ranges::find_if(stations, [&](const DrivenStation& station) {
    return station.pilot_deg > from_deg + kSameAngle_deg;
  });
  if (beyond == stations.begin()) return {};
  auto high = beyond - 1;
  if (high->pilot_deg < from_deg - kSameAngle_deg && beyond == stations.end()) return {};
  if (!(high->n_mm_per_deg > 0)) return {};
  for (; high != stations.begin(); --high) {
    const DrivenStation& low = *(high - 1);
    if (low.n_mm_per_deg <= 0) return minimum_deg(low, *high);
  }
  return 0;
}

std::optional<Stop> stop_of(const FoldingHistory& history, const Filling& filling, double from_deg,
                            double friction_n_mm_per_mm) {
  const auto with = [&](double friction) {
    return stop_deg(driven_stations(history, filling, friction), from_deg);
  };
  const std::optional<double> at_deg = with(friction_n_mm_per_mm);
  if (!at_deg) return {};
  if (friction_n_mm_per_mm == 0) return Stop{*at_deg, *at_deg};
  return Stop{*at_deg, with(-friction_n_mm_per_mm).value_or(0)};
}

void MiscutStops::add(const std::optional<Stop>& stop) {
  if (!stop) {
    ++held;
  } else if (stop->at_deg == 0) {
    ++flat;
  } else {
    stops.push_back(*stop);
  }
}

void MiscutStops::add(const MiscutStops& others) {
  stops.insert(stops.end(), others.stops.begin(), others.stops.end());
  flat += others.flat;
  held += others.held;
}

std::vector<double> MiscutStops::sorted(double Stop::*value) const {
  std::vector<double> values;
  for (const Stop& stop : stops) values.push_back(stop.*value);
  std::ranges::sort(values);
  return values;
}

}  // namespace misalign::solver
