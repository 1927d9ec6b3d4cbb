// Finds where miscut copies of a sheet come to rest whose springs or plates fit the sheet itself.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/fill/filling.hpp"
#include "solver/records/history.hpp"

namespace misalign::solver {

/// Stops of miscut copies.
struct MiscutStops {
  std::vector<double> stops_deg;  ///< pilot angles of copies that stop short of flat, ascending
  std::uint64_t flat = 0;         ///< copies that unfold flat
  std::uint64_t held = 0;         ///< copies that fold on, or do not reach the angle of use

  void add(const std::optional<double>& stop_deg);
  void add(const MiscutStops& others);
  std::uint64_t trials() const { return stops_deg.size() + flat + held; }
  /// Quantile of the stops, of which there is at least one: 0.5 is the median.
  double quantile_deg(double share) const;
};

/// The pilot angle where a sheet stops that is let go at `from_deg` and moves slowly: the first on
/// the way to flat at which the energy of its filling rises again; 0 for flat. None where the
/// filling does not drive it towards flat from there, or its path ends before. Errors: that of a
/// cubic through the energies of two neighbouring stations; of plates, whose wrinkles turn there, a
/// twentieth of their distance.
std::optional<double> stop_deg(const FoldingHistory& history, const Filling& filling,
                               double from_deg);

}  // namespace misalign::solver
