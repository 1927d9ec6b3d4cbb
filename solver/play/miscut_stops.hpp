// Finds where copies of a sheet come to rest whose springs or plates fit the sheet itself.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/fill/filling.hpp"
#include "solver/records/history.hpp"

namespace misalign::solver {

/// The energy of a sheet's filling at a pilot angle, and its rate.
struct DrivenStation {
  double pilot_deg, energy_n_mm, n_mm_per_deg;
};

/// The stations of a history. Dry friction of the creases (N mm per mm of crease) takes its work
/// from the energy that falls on the way to flat; with a negative one, from that on the way back.
std::vector<DrivenStation> driven_stations(const FoldingHistory& history, const Filling& filling,
                                           double friction_n_mm_per_mm = 0);

/// The pilot angle where a sheet stops that is let go at `from_deg` and moves slowly: the first on
/// the way to flat at which the energy rises again; 0 for flat. None where the filling does not
/// drive it towards flat from there, or its path ends before. Errors: that of a cubic through the
/// energies of two neighbouring stations, ascending; of plates, whose wrinkles turn there, a
/// twentieth of their distance.
std::optional<double> stop_deg(const std::vector<DrivenStation>& stations, double from_deg);

/// The stop of a copy, in degrees of its pilot.
struct Stop {
  double at_deg;         ///< the copy stops there; without friction its filling's least energy
  double held_from_deg;  ///< dry friction holds it between this angle and that
  double shape_rms_mm = 0, shape_max_mm = 0;  ///< distances from a target there, if it is measured
};

/// The stop of a sheet that is let go at `from_deg`, as above, without its shape.
std::optional<Stop> stop_of(const FoldingHistory& history, const Filling& filling, double from_deg,
                            double friction_n_mm_per_mm);

/// Stops of copies.
struct MiscutStops {
  std::vector<Stop> stops;  ///< copies that stop short of flat
  std::uint64_t flat = 0;   ///< copies that unfold flat
  std::uint64_t held = 0;   ///< copies that fold on, do not move or do not reach the angle of use

  void add(const std::optional<Stop>& stop);
  void add(const MiscutStops& others);
  std::uint64_t trials() const { return stops.size() + flat + held; }
  /// One value of all stops, ascending.
  std::vector<double> sorted(double Stop::*value) const;
};

}  // namespace misalign::solver
