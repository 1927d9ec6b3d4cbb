// Equilibria of a sheet at rest: where its energy has wells, what friction can hold, and what it
// must not exceed.
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/energy_model.hpp"

namespace misalign::solver {

/// Where the potential is stationary between two angles of the way.
struct Equilibrium {
  double x, pilot_deg;
  double energy_n_mm;
  /// d2E / d(pilot)2, N mm/rad2: positive in a well. Flat it is 0 where springs are relaxed flat:
  /// there the energy grows with the fourth power.
  double stiffness_n_mm;
  bool is_well;
};

/// All from -end to end of the way, ascending; flat, where the way has its symmetry, exactly. None
/// where nothing changes its energy, such as springs of a sheet without shifts.
std::vector<Equilibrium> find_equilibria(const EnergyModel& sheet);

/// Limits of dry friction for a sheet released at rest at a pilot angle, to deploy.
struct FrictionLimits {
  /// The largest friction of the creases (N mm per mm) with which it reaches flat: the least over
  /// the way of (E(from) - E) / (sum of l_i times how far crease i has turned), its limit at the
  /// start included. Whatever the mass, but without damping. None where it does not set out for
  /// flat, or does not get there at all.
  std::optional<double> critical_n_mm_per_mm;
  double critical_deg = 0;  ///< where on the way it is the least
  /// Where a sheet with its own friction would stop if it moved slowly: the first pilot angle on
  /// the way to flat at which the moment is not more than that. 0 without friction.
  double static_stall_deg = 0;
  /// The springs (N/mm) for which its own friction would be the critical one; none without
  /// friction, or where springs do not drive it to flat.
  std::optional<double> stiffness_needed_n_per_mm;
};

/// The friction that a sheet overcomes which is let go at from_deg, above 0.
FrictionLimits find_friction_limits(const EnergyModel& sheet, double from_deg);

}  // namespace misalign::solver
